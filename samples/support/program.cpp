#include "samples/support/program.h"

#include "engine/error.h"
#include "engine/gpu/lavapipe.h"
#include "engine/log.h"
#include "samples/support/numbers.h"
#include "samples/support/standard_streams.h"
#include <cstdio>
#include <new>
#include <sstream>
#include <system_error>

namespace irradia {
namespace {

int report(const std::string& name, const std::string& sentence, ExitCode code) {
    std::fflush(stdout);
    logLine("{}: {}", name, sentence);
    return static_cast<int>(code);
}

// --help and --version.
void answer(const CLI::App& program, const CLI::Success& request) {
    std::ostringstream text;
    program.exit(request, text);
    writeResult(text.str());
}

} // namespace

int runProgram(const std::string& description, const std::string& name,
               const std::function<void(CLI::App& program)>& work) {
    prepareStandardStreams();
    preferWideVectors();
    CLI::App program(description, name);
    try {
        try {
            work(program);
        } catch (const CLI::Success& request) {
            answer(program, request);
        }
        finishResults();
        return static_cast<int>(ExitCode::Ok);
    } catch (const CLI::ParseError& error) {
        return report(name, error.what(), ExitCode::Usage);
    } catch (const Error& error) {
        return report(name, error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return report(name, "out of memory", ExitCode::OutOfMemory);
    } catch (const std::system_error& error) { // of files
        return report(name, error.what(), ExitCode::Io);
    } catch (const std::exception& error) {
        return report(name, error.what(), ExitCode::Internal);
    }
}

glm::uvec2 parseSize(const std::string& text) {
    constexpr uint32_t kMost = 16384;
    const size_t x = text.find('x');
    const auto width = toWhole(text.substr(0, x), 1, kMost);
    const auto height = x == std::string::npos ? std::nullopt : toWhole(text.substr(x + 1), 1, kMost);
    if (!width || !height) fail(ExitCode::Usage, "--size {}: not WxH with both from 1 to {}", text, kMost);
    return {*width, *height};
}

} // namespace irradia
