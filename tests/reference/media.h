// The solids around a path: what is inside a closed surface that transmits and is not thin
// (KHR_materials_volume).
#pragma once

#include "engine/scene/scene.h"
#include "tests/reference/math.h"

namespace irradia::reference {

constexpr int kNoMedium = -1;

// The two innermost solids that a path is in, by material.
struct Media {
    int top = kNoMedium;
    int below = kNoMedium;

    Media entered(int solid) const { return {solid, top}; }
    Media left(int solid) const {
        if (top == solid) return {below, kNoMedium};
        return below == solid ? Media{top, kNoMedium} : *this;
    }
    // What meets the back of a solid is inside of it, whatever the path has been through.
    Media within(int solid) const { return top == solid ? *this : Media{solid, top}; }
};

// On the sides of a surface where a path meets it.
struct MediaBySide {
    Media here;  // on the side that the path comes from
    Media there; // beyond
};

inline bool isSolid(const Material& m) {
    return !m.isThin && m.transmission > 0.0f;
}

inline MediaBySide mediaAt(const Scene& scene, uint32_t material, bool front, const Media& path) {
    const int solid = static_cast<int>(material);
    if (!isSolid(scene.materials[material])) return {path, path};
    return front ? MediaBySide{path, path.entered(solid)} : MediaBySide{path.within(solid), path.left(solid)};
}

inline double indexOf(const Scene& scene, int medium) {
    return medium == kNoMedium ? 1.0 : static_cast<double>(scene.materials[medium].ior);
}

// Share of light that is left after a way through a medium (Beer and Lambert).
inline Vec3 attenuation(const Scene& scene, int medium, double distance) {
    if (medium == kNoMedium) return Vec3(1.0);
    return glm::exp(-distance * Vec3(scene.materials[medium].absorption));
}

} // namespace irradia::reference
