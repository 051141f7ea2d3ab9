// The command line: names the subcommands and runs one.
#include "commands.h"
#include "engine/error.h"
#include "samples/support/program.h"

namespace irradia {
namespace {

void addCommands(CLI::App& program) {
    program.set_version_flag("--version", "irradia " IRRADIA_VERSION);
    program.require_subcommand(1);
    addRender(program);
    addCompare(program);
    addInfo(program);
    addValidate(program);
    addDevices(program);
    addBench(program);
}

// CLI11 would call an unknown subcommand a missing one.
void refuseUnknownCommand(const CLI::App& program, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    const auto isNamed = [argv](const CLI::App* command) { return command->check_name(argv[1]); };
    if (program.get_subcommands(isNamed).empty())
        fail(ExitCode::Usage, "unknown subcommand {}, irradia --help lists them", argv[1]);
}

} // namespace
} // namespace irradia

int main(int argc, char** argv) {
    using namespace irradia;
    return runProgram("A path tracer in Vulkan compute.", "irradia", [&](CLI::App& program) {
        addCommands(program);
        refuseUnknownCommand(program, argc, argv);
        program.parse(argc, argv);
    });
}
