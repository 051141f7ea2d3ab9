#include "samples/support/program.h"

#include "engine/error.h"
#include "engine/gpu/lavapipe.h"
#include <cstdio>
#include <new>

namespace irradia {
namespace {

int report(const std::string& name, const std::string& sentence, ExitCode code) {
    std::fflush(stdout);
    fmt::print(stderr, "{}: {}\n", name, sentence);
    return static_cast<int>(code);
}

} // namespace

int runProgram(const std::string& description, const std::string& name,
               const std::function<void(CLI::App& program)>& work) {
    preferWideVectors();
    CLI::App program(description, name);
    try {
        work(program);
        if (std::fflush(stdout) != 0) fail(ExitCode::Io, "stdout: cannot be written");
        return static_cast<int>(ExitCode::Ok);
    } catch (const CLI::Success& request) { // --help, --version
        return program.exit(request);
    } catch (const CLI::ParseError& error) {
        return report(name, error.what(), ExitCode::Usage);
    } catch (const Error& error) {
        return report(name, error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return report(name, "out of memory", ExitCode::OutOfMemory);
    } catch (const std::exception& error) {
        return report(name, error.what(), ExitCode::Internal);
    }
}

glm::uvec2 parseSize(const std::string& text) {
    unsigned width = 0, height = 0;
    int used = 0;
    const bool read =
        std::sscanf(text.c_str(), "%5ux%5u%n", &width, &height, &used) == 2 && size_t(used) == text.size();
    if (!read || width < 1 || height < 1 || width > 16384 || height > 16384)
        fail(ExitCode::Usage, "--size {}: not WxH with both from 1 to 16384", text);
    return {width, height};
}

} // namespace irradia
