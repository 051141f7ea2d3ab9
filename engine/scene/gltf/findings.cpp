#include "engine/scene/gltf/findings.h"

#include <algorithm>
#include <fmt/format.h>

namespace irradia::gltf {
namespace {

constexpr size_t kMostShown = 64;       // of a load
constexpr size_t kMostCollected = 1000; // of each sort

} // namespace

Thing Thing::at(std::string_view member) const {
    Thing result{name, pointer + "/"};
    for (const char c : member) { // RFC 6901, 3
        if (c == '~')
            result.pointer += "~0";
        else if (c == '/')
            result.pointer += "~1";
        else
            result.pointer += c;
    }
    return result;
}

Thing thing(std::string_view kind, std::string_view array, size_t index, const std::string& name) {
    return {name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} {} '{}'", kind, index, name),
            fmt::format("/{}/{}", array, index)};
}

void Findings::keep(Finding finding) {
    const bool isError = finding.severity == Severity::Error;
    size_t& count = isError ? errors_ : others_;
    const size_t most = collects() ? kMostCollected : kMostShown;
    if (count > most) return;
    const auto isSame = [&](const Finding& other) {
        return other.message == finding.message && other.pointer == finding.pointer;
    };
    if (std::ranges::any_of(all_, isSame)) return;
    if (count++ == most) {
        const std::string more = isError ? "there are more errors" : "there are more warnings";
        finding = {finding.severity, "", "", more, more};
    }
    all_.push_back(std::move(finding));
}

} // namespace irradia::gltf
