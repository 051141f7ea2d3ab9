#include "tests/support/glass_harness.h"

#include "engine/scene/glass_table.h"
#include "engine/scene/reflectance_table.h"
#include "kernels/shaders.h"
#include "tests/support/bsdf_harness.h"
#include <algorithm>

namespace irradia::test {

GlassCase whiteGlass(double eta, double roughness, double mu) {
    GlassCase c;
    const double f0 = (eta - 1.0) / (eta + 1.0);
    c.f0 = glm::vec3(static_cast<float>(f0 * f0));
    c.ior = static_cast<float>(std::max(eta, 1.0 / eta));
    c.eta = static_cast<float>(eta);
    c.roughness = static_cast<float>(roughness);
    c.view = glm::vec3(reference::direction(mu, 0.3));
    return c;
}

GlassCase whiteSheet(double roughness, double mu) {
    GlassCase c = whiteGlass(1.5, roughness, mu);
    c.isSheet = true;
    return c;
}

Buffer caseBuffer(const std::vector<GlassCase>& cases) {
    std::vector<glm::vec4> records;
    for (const GlassCase& c : cases) {
        records.emplace_back(c.base, c.metallic);
        records.emplace_back(c.f0, c.specular);
        records.emplace_back(c.view, c.roughness);
        records.emplace_back(c.eta, c.transmission, c.isSheet ? 1.0f : 0.0f, c.ior);
    }
    return quadBuffer(records);
}

const Buffer& glassTable() {
    static const Buffer* table =
        new Buffer(quadBuffer(buildGlassTable(buildReflectanceTable()))); // never destroyed, as the device
    return *table;
}

std::vector<GlassEvaluation> evaluateGlass(const std::vector<GlassCase>& cases,
                                           const std::vector<glm::vec3>& directions,
                                           const std::vector<Specialisation>& faults) {
    KernelHarness kernel(kernels::glass_evaluate, faults);
    std::vector<glm::vec4> records;
    for (const glm::vec3& l : directions) records.emplace_back(l, 0.0f);
    const Buffer inputs = caseBuffer(cases), towards = quadBuffer(records);
    const gpu::BsdfHarnessParams params{static_cast<uint32_t>(cases.size()), 0, 0, 0};
    const auto results = kernel.run({inputs, reflectanceTable(), glassTable(), towards}, params, cases.size(),
                                    4 * cases.size());
    std::vector<GlassEvaluation> evaluations;
    for (size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4 value = toFloats(results[4 * i]), lobes = toFloats(results[4 * i + 1]),
                        more = toFloats(results[4 * i + 2]), punctual = toFloats(results[4 * i + 3]);
        evaluations.push_back({glm::vec3(value), value.w, lobes.x, lobes.y, lobes.z, lobes.w, punctual.w,
                               more.x, more.y, more.z, more.w > 0.0f, glm::vec3(punctual)});
    }
    return evaluations;
}

} // namespace irradia::test
