#include "tests/support/bsdf_harness.h"

#include "engine/scene/reflectance_table.h"
#include "kernels/shaders.h"

namespace irradia::test {

BsdfCase bsdfCase(const reference::BsdfParameters& p, double mu, double azimuth) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return {{reference::Vec3(glm::vec3(p.baseColor)), rounded(p.metallic), rounded(p.roughness),
             reference::Vec3(glm::vec3(p.f0)), rounded(p.specular)},
            glm::vec3(reference::direction(mu, azimuth))};
}

Buffer caseBuffer(const std::vector<BsdfCase>& cases) {
    std::vector<glm::vec4> records;
    for (const BsdfCase& c : cases) {
        records.emplace_back(glm::vec3(c.material.baseColor), c.material.metallic);
        records.emplace_back(glm::vec3(c.material.f0), c.material.specular);
        records.emplace_back(c.view, c.material.roughness);
    }
    return quadBuffer(records);
}

const Buffer& reflectanceTable() {
    static const Buffer* table =
        new Buffer(quadBuffer(buildReflectanceTable())); // never destroyed, as the device
    return *table;
}

std::vector<BsdfEvaluation> evaluateBsdf(const std::vector<BsdfCase>& cases,
                                         const std::vector<glm::vec3>& directions,
                                         const std::vector<Specialisation>& faults) {
    KernelHarness kernel(kernels::bsdf_evaluate, faults);
    std::vector<glm::vec4> records;
    for (const glm::vec3& l : directions) records.emplace_back(l, 0.0f);
    const Buffer inputs = caseBuffer(cases), towards = quadBuffer(records);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(cases.size()), 0, 0, 0};
    const auto results =
        kernel.run({inputs, reflectanceTable(), towards}, params, cases.size(), 2 * cases.size());
    std::vector<BsdfEvaluation> evaluations;
    for (size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4 value = toFloats(results[2 * i]), more = toFloats(results[2 * i + 1]);
        evaluations.push_back({glm::vec3(value), value.w, more.x, more.y});
    }
    return evaluations;
}

} // namespace irradia::test
