#include "methods.h"

#include "engine/error.h"
#include "views.h"
#include <algorithm>

namespace irradia {
namespace {

struct Method {
    const char* name;
    bool hasCache;
};
constexpr Method kMethods[] = {{"pt", false}, {"nrc", true}, {"cache-view", true}};

constexpr const char* kOptionsOfCaches[] = {"--preset", "--network", "--warmup"};

bool isGiven(const CLI::App& command, const char* name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option && option->count() > 0;
}

} // namespace

bool methodHasCache(const std::string& method) {
    const auto* const found =
        std::ranges::find_if(kMethods, [&](const Method& known) { return method == known.name; });
    if (found == std::end(kMethods))
        fail(ExitCode::Usage, "--method {} is unknown; there are pt, nrc and cache-view", method);
    return found->hasCache;
}

void requireOptionsOf(const std::string& method, const CLI::App& command) {
    if (methodHasCache(method)) return;
    for (const char* name : kOptionsOfCaches)
        if (isGiven(command, name))
            fail(ExitCode::Usage, "{} is for the methods with a cache; --method {} has none", name, method);
    if (!isGiven(command, "--view")) return;
    const View& view = findView(command.get_option("--view")->as<std::string>());
    if (view.needsCache())
        fail(ExitCode::Usage, "--view {} is for the methods with a cache; --method {} has none", view.name,
             method);
}

} // namespace irradia
