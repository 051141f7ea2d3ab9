// The command line: names the subcommands, runs one, and turns whatever went wrong into a sentence and an
// exit code.
#include "commands.h"
#include "engine/error.h"
#include <cstdio>
#include <new>

namespace irradia {
namespace {

void addCommands(CLI::App& program) {
    program.set_version_flag("--version", "irradia " IRRADIA_VERSION);
    program.require_subcommand(1);
    addRender(program);
    addCompare(program);
    addDevices(program);
    addBench(program);
    addLaterCommands(program);
}

// CLI11 would call an unknown subcommand a missing one.
void refuseUnknownCommand(const CLI::App& program, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    const auto isNamed = [argv](const CLI::App* command) { return command->check_name(argv[1]); };
    if (program.get_subcommands(isNamed).empty())
        fail(ExitCode::Usage, "unknown subcommand {}, irradia --help lists them", argv[1]);
}

void run(CLI::App& program, int argc, char** argv) {
    addCommands(program);
    refuseUnknownCommand(program, argc, argv);
    program.parse(argc, argv);
    if (std::fflush(stdout) != 0) fail(ExitCode::Io, "stdout: cannot be written");
}

int report(const std::string& sentence, ExitCode code) {
    std::fflush(stdout);
    fmt::print(stderr, "irradia: {}\n", sentence);
    return static_cast<int>(code);
}

} // namespace
} // namespace irradia

int main(int argc, char** argv) {
    using namespace irradia;
    CLI::App program("A path tracer in Vulkan compute.", "irradia");
    try {
        run(program, argc, argv);
        return static_cast<int>(ExitCode::Ok);
    } catch (const CLI::Success& request) { // --help, --version
        return program.exit(request);
    } catch (const CLI::ParseError& error) {
        return report(error.what(), ExitCode::Usage);
    } catch (const Error& error) {
        return report(error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return report("out of memory", ExitCode::OutOfMemory);
    } catch (const std::exception& error) {
        return report(error.what(), ExitCode::Internal);
    }
}
