#include "engine/image/primaries.h"

#include <algorithm>

namespace irradia {
namespace {

// Imath multiplies rows from the left: its rows are glm's columns.
glm::mat3 toColumns(const Imath::M44f& m) {
    glm::mat3 result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result[i][j] = m[i][j];
    return result;
}

bool isSame(const Imath::V2f& a, const Imath::V2f& b) {
    constexpr float kRounding = 1e-3f; // programs store three or four digits
    return std::abs(a.x - b.x) < kRounding && std::abs(a.y - b.y) < kRounding;
}

glm::mat3 adaptWhite(const glm::vec3& from, const glm::vec3& to) {
    const glm::mat3 cones = glm::transpose(glm::mat3(0.8951f, 0.2664f, -0.1614f, //
                                                     -0.7502f, 1.7135f, 0.0367f, //
                                                     0.0389f, -0.0685f, 1.0296f));
    const glm::vec3 gain = (cones * to) / (cones * from);
    return glm::inverse(cones) * glm::mat3(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cones;
}

} // namespace

glm::mat3 matrixToRec709(const Imf::Chromaticities& from) {
    const Imf::Chromaticities rec709;
    if (isSame(from.red, rec709.red) && isSame(from.green, rec709.green) && isSame(from.blue, rec709.blue) &&
        isSame(from.white, rec709.white))
        return glm::mat3(1.0f);
    const glm::mat3 toXyz = toColumns(Imf::RGBtoXYZ(from, 1.0f));
    const glm::mat3 white709 = toColumns(Imf::RGBtoXYZ(rec709, 1.0f));
    const glm::vec3 one(1.0f);
    return toColumns(Imf::XYZtoRGB(rec709, 1.0f)) * adaptWhite(toXyz * one, white709 * one) * toXyz;
}

} // namespace irradia
