#include "samples/support/outputs.h"

#include "engine/error.h"
#include "engine/image/image.h"
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/ranges.h>

namespace irradia {
namespace {

bool isNamed(const NamedFile& named) {
    return !named.file.empty() && named.file != "-";
}

// Of files that exist by their place on the disk, else by their names behind links.
bool isSameFile(const std::string& a, const std::string& b) {
    std::error_code error;
    if (std::filesystem::equivalent(a, b, error)) return true;
    const auto whole = [&error](const std::string& file) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
    };
    const auto first = whole(a);
    return !error && first == whole(b) && !error;
}

} // namespace

CLI::Option* addOutput(CLI::App& command, const std::string& name, std::string& file,
                       const std::string& meaning) {
    const std::string shortest = name.substr(0, name.find(','));
    const CLI::callback_t read = [&file, shortest](const CLI::results_t& texts) {
        file = texts.back();
        if (file.empty()) fail(ExitCode::Usage, "{}: the file's name is empty", shortest);
        return true;
    };
    return command.add_option(name, read, meaning)->type_name("FILE");
}

bool hasEnding(const std::string& file, const std::string& ending) {
    const auto areEqual = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return file.size() >= ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), file.rbegin(), areEqual);
}

void requireEnding(const NamedFile& output, std::initializer_list<const char*> endings) {
    const auto isEnding = [&](const char* ending) { return hasEnding(output.file, ending); };
    if (output.file.empty() || std::any_of(endings.begin(), endings.end(), isEnding)) return;
    fail(ExitCode::Usage, "{} {}: the name must end in {}", output.name, output.file,
         fmt::join(endings, " or "));
}

void requireApart(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    for (size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& output = outputs[i];
        if (!isNamed(output)) continue;
        for (const NamedFile& input : inputs)
            if (isNamed(input) && isSameFile(output.file, input.file))
                fail(ExitCode::Usage, "{} {}: is {}, which would be lost", output.name, output.file,
                     input.name);
        for (size_t other = 0; other < i; ++other)
            if (isNamed(outputs[other]) && isSameFile(output.file, outputs[other].file))
                fail(ExitCode::Usage, "{} {}: is the file of {} too", output.name, output.file,
                     outputs[other].name);
    }
}

void checkOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    requireApart(outputs, inputs);
    for (const NamedFile& output : outputs)
        if (isNamed(output)) requireWritable(output.file);
}

} // namespace irradia
