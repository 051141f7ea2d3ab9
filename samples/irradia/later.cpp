// Subcommands that are planned: named in the help, and refused in one sentence.
#include "commands.h"
#include "engine/error.h"

namespace irradia {
namespace {

struct LaterCommand {
    const char* name;
    const char* meaning;
};

constexpr LaterCommand kLaterCommands[] = {
    {"view", "an interactive window"},    {"train", "neural radiosity"}, {"chart", "speed against accuracy"},
    {"merge", "combine partial renders"}, {"info", "a file's metadata"}, {"validate", "check a scene"},
};

} // namespace

void addLaterCommands(CLI::App& program) {
    for (const auto& [name, meaning] : kLaterCommands) {
        CLI::App* command = program.add_subcommand(name, fmt::format("Comes later: {}", meaning));
        command->allow_extras(); // whatever its options will be
        command->callback(
            [name = name] { fail(ExitCode::Usage, "{} is not in this version, it comes later", name); });
    }
}

} // namespace irradia
