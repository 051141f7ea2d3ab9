// A small file of many sorts of things, for tests to spoil.
#pragma once

#include "engine/image/image.h"
#include "tests/gltf_builder.h"
#include <functional>

namespace irradia::test {

// A lamp of two triangles that stands twice, textured; a camera, a skin, a morph target; extensions of each
// sort.
inline GltfBuilder lamps() {
    GltfBuilder builder;
    const int positions = builder.vec3({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
    const int uv = builder.vec2({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int colours = builder.vec3(std::vector<glm::vec3>(4, glm::vec3(0.5f)));
    builder.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}, {"COLOR_0", colours}}},
                  {"targets", {{{"POSITION", positions}}}},
                  {"indices", builder.indices({0, 1, 2, 0, 2, 3})},
                  {"material", 0}});
    builder.root({{"mesh", 0}, {"translation", {0, 0, 5}}});
    builder.root({{"camera", 0},
                  {"translation", {0, 0, 9}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    const int picture = builder.view(encodePng({3, 2, std::vector<uint8_t>(24, 255)}));
    builder.json["images"] = {{{"bufferView", picture}, {"mimeType", "image/png"}, {"name", "glow"}},
                              {{"uri", "unused.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"emissiveFactor", {1, 1, 1}},
                                  {"emissiveTexture", {{"index", 0}}},
                                  {"alphaMode", "BLEND"},
                                  {"extensions",
                                   {{"KHR_materials_ior", {{"ior", 1.4}}},
                                    {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}}};
    builder.json["cameras"] = {
        {{"name", "door"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_transmission",
                                      "KHR_lights_punctual", "KHR_materials_sheen", "VENDOR_secret"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}}, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}}}}};
    builder.json["asset"]["generator"] = "a test";
    return builder;
}

using Spoil = std::function<void(Json&)>;

inline std::filesystem::path spoiled(const TempFolder& folder, const Spoil& spoil) {
    GltfBuilder builder = lamps();
    spoil(builder.json);
    return folder.write("scene.glb", builder.glb());
}

} // namespace irradia::test
