#include "bench_mlp_compile.h"
#include "bench_mlp_rounds.h"
#include "engine/error.h"
#include "samples/support/interrupt.h"
#include "shared/network.h"
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace irradia {
namespace {

class EmptyShaderCache {
public:
    EmptyShaderCache() {
        std::string name = (std::filesystem::temp_directory_path() / "irradia-shaders-XXXXXX").string();
        if (!mkdtemp(name.data())) fail(ExitCode::Io, "{}: cannot be made", name);
        folder_ = name;
        setenv("MESA_SHADER_CACHE_DIR", name.c_str(), 1);
    }
    ~EmptyShaderCache() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    EmptyShaderCache(const EmptyShaderCache&) = delete;
    EmptyShaderCache& operator=(const EmptyShaderCache&) = delete;

private:
    std::filesystem::path folder_;
};

struct FirstRun {
    std::string kernel;
    double seconds = 0;
};

// So few rows that executing is nothing beside compiling.
std::vector<FirstRun> firstRuns(Device& device, const MlpCase& what) {
    const MlpProblem problem = makeMlpProblem(what.shape, gpu::kRowPadding);
    const auto start = std::chrono::steady_clock::now();
    const std::unique_ptr<MlpRun> run = startCase(device, what, problem);
    std::vector<FirstRun> runs{
        {kPipelines, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}};
    run->run();
    for (const Profiler::Row& row : run->passes())
        if (row.name != "fill" && row.name != "copy") runs.push_back({row.name, 1e-3 * row.p50});
    return runs;
}

} // namespace

std::vector<CompileTime> measureCompileTimes(const DeviceOptions& options,
                                             const std::vector<MlpCase>& cases) {
    const EmptyShaderCache cache;
    std::vector<CompileTime> times;
    for (const bool isCached : {false, true}) {
        Device device(options);
        size_t next = 0;
        for (const MlpCase& what : cases) {
            stopIfInterrupted();
            for (const FirstRun& run : firstRuns(device, what))
                if (isCached)
                    times.at(next++).cached = run.seconds;
                else
                    times.push_back({what, run.kernel, run.seconds});
        }
    }
    return times;
}

} // namespace irradia
