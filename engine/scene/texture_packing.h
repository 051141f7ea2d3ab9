// Pictures of a scene as linear half-float texels in one run, each stored once per use (sRGB or linear).
#pragma once

#include "engine/scene/scene.h"
#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace irradia {

class TexturePacker {
public:
    explicit TexturePacker(const Scene& scene)
        : scene_(scene) {}

    // The material's code for a texture: quad index << 1 | uv set, or gpu::kNoTexture.
    uint32_t add(const TextureRef& use, bool srgb);

    // Some picture is used by transformed coordinates. Of what has been added.
    bool hasTransforms() const;

    // Writes the texture quads and all texels. Where they exceed maxTexels the largest pictures are halved
    // (box filter) until they fit; each is named in `warnings`.
    void pack(uint64_t maxTexels, std::vector<glm::uvec4>& quads, std::vector<glm::uvec2>& texels,
              std::vector<std::string>& warnings) const;

private:
    struct Use {
        int image;
        bool srgb;
        Wrap wrapS, wrapT;
        std::array<float, 6> transform; // by columns
        auto operator<=>(const Use&) const = default;
    };
    static bool isTransformed(const Use& use);

    const Scene& scene_;
    std::map<Use, uint32_t> indices_;
    std::vector<Use> uses_;
};

// sRGB's transfer function (IEC 61966-2-1) of an 8-bit value.
float srgbToLinear(uint8_t value);

} // namespace irradia
