#include "samples/session/kernel_form.h"

#include "engine/error.h"
#include <fmt/ranges.h>

namespace irradia {
namespace {

struct Named {
    const char* name;
    KernelForm form;
};
constexpr Named kForms[] = {
    {"auto", {}},
    {"texel", {.access = QuadAccess::Texel}},
    {"storage", {.access = QuadAccess::Storage}},
    {"subgroup", {.network = NetworkForm::Subgroup}},
    {"workgroup", {.network = NetworkForm::Workgroup}},
};

} // namespace

std::vector<std::string> kernelFormNames() {
    std::vector<std::string> names;
    for (const Named& form : kForms) names.emplace_back(form.name);
    return names;
}

KernelForm kernelForm(const std::string& name) {
    for (const Named& form : kForms)
        if (name == form.name) return form.form;
    fail(ExitCode::Usage, "--form {} is unknown; there are {}", name, fmt::join(kernelFormNames(), ", "));
}

const char* accessName(const Device& device) {
    return device.texelQuads() ? "texel" : "storage";
}

} // namespace irradia
