#include "methods.h"

#include "engine/error.h"
#include "samples/session/kernel_form.h"
#include "samples/session/views.h"
#include <fmt/ranges.h>

namespace irradia {
namespace {

bool isGiven(const CLI::App& command, const std::string& name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option && option->count() > 0;
}

std::vector<const Method*> allMethods() {
    std::vector<const Method*> methods;
    for (const std::string& name : methodNames()) methods.push_back(&findMethod(name));
    return methods;
}

// An option of the command line that a method would pass over, and the methods that would not.
struct Foreign {
    std::string option; // empty: there is none
    std::vector<std::string> methods;
};

template <typename Takes>
Foreign foreign(const std::string& option, const Takes& takes) {
    Foreign found{option, {}};
    for (const Method* method : allMethods())
        if (takes(*method)) found.methods.push_back(method->name);
    return found;
}

Foreign findForeign(const Method& method, const CLI::App& command) {
    for (const Method* other : allMethods())
        for (const MethodOption& option : other->options)
            if (isGiven(command, "--" + option.name) && !method.option(option.name))
                return foreign("--" + option.name,
                               [&](const Method& m) { return m.option(option.name) != nullptr; });
    if (isGiven(command, "--warmup") && method.warmup == 0)
        return foreign("--warmup", [](const Method& m) { return m.warmup > 0; });
    if (method.hasCache) return {};
    const auto hasCache = [](const Method& m) { return m.hasCache; };
    if (isGiven(command, "--form")) {
        const auto form = command.get_option("--form")->as<std::string>();
        if (kernelForm(form).network != NetworkForm::Auto) return foreign("--form " + form, hasCache);
    }
    if (!isGiven(command, "--view")) return {};
    const View& view = findView(command.get_option("--view")->as<std::string>());
    if (!view.needsCache()) return {};
    return foreign(fmt::format("--view {}", view.name), hasCache);
}

} // namespace

void addMethodOptions(CLI::App& command, std::string& method, std::map<std::string, std::string>& given) {
    std::vector<std::string> lines;
    for (const Method* known : allMethods())
        lines.push_back(fmt::format("{} ({})", known->name, known->help));
    command.add_option("--method", method, fmt::format("{}", fmt::join(lines, ", ")))
        ->group("Method")
        ->capture_default_str();
    for (const Method* known : allMethods())
        for (const MethodOption& option : known->options) {
            if (command.get_option_no_throw("--" + option.name)) continue; // as of a method before
            const std::function<void(const std::string&)> keep =
                [&given, name = option.name](const std::string& value) { given[name] = value; };
            command.add_option_function("--" + option.name, keep, option.help)
                ->group("Method")
                ->default_str(option.usual);
        }
}

std::string chooseMethod(const std::string& named, uint32_t maxBounces, const CLI::App& command) {
    if (!named.empty()) return named;
    const Method& method = usualMethod(maxBounces);
    return findForeign(method, command).option.empty() ? method.name : usualMethod(1).name;
}

void requireOptionsOf(const std::string& method, const CLI::App& command) {
    const Foreign found = findForeign(findMethod(method), command);
    if (!found.option.empty())
        fail(ExitCode::Usage, "{} is for the methods {}; --method {} has none", found.option,
             fmt::join(found.methods, ", "), method);
}

std::string optionsText(const Method& method, const std::map<std::string, std::string>& given) {
    std::vector<std::string> texts;
    for (const MethodOption& option : method.options)
        texts.push_back(fmt::format("--{} '{}'", option.name, valueOf(given, option)));
    return fmt::format("{}", fmt::join(texts, " "));
}

} // namespace irradia
