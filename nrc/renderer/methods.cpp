#include "nrc/renderer/methods.h"

#include "engine/error.h"
#include "nrc/renderer/nrc_methods.h"
#include "nrc/renderer/path_tracing.h"
#include <algorithm>
#include <deque>
#include <fmt/ranges.h>

namespace irradia {
namespace {

std::deque<Method>& table() {
    static std::deque<Method> methods{pathTracing(), nrc(), cacheView()};
    return methods;
}

const Method* find(std::string_view name) {
    const auto found = std::ranges::find(table(), name, &Method::name);
    return found == table().end() ? nullptr : &*found;
}

} // namespace

const std::string& valueOf(const std::map<std::string, std::string>& given, const MethodOption& option) {
    const auto found = given.find(option.name);
    return found == given.end() ? option.usual : found->second;
}

const MethodOption* Method::option(std::string_view named) const {
    const auto found = std::ranges::find(options, named, &MethodOption::name);
    return found == options.end() ? nullptr : &*found;
}

std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const Method& method : table()) names.push_back(method.name);
    return names;
}

const Method& findMethod(std::string_view name) {
    if (const Method* method = find(name)) return *method;
    fail(ExitCode::Usage, "--method {} is unknown; there are {}", name, fmt::join(methodNames(), ", "));
}

void addMethod(Method method) {
    if (find(method.name)) fail(ExitCode::Internal, "there is a method {} already", method.name);
    table().push_back(std::move(method));
}

const Method& usualMethod(uint32_t maxBounces) {
    return findMethod(maxBounces > 0 ? "nrc" : "pt");
}

void requireApplies(const Method& method, const Scene& scene) {
    const std::string reason = method.whyNot ? method.whyNot(scene) : "";
    if (!reason.empty())
        fail(ExitCode::Usage, "--method {} does not apply to scene {}: {}", method.name, scene.name, reason);
}

} // namespace irradia
