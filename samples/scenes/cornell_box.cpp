// The measured Cornell box: "Cornell Box Data", Cornell University Program of Computer Graphics, 7 January
// 1998 (coordinates in millimetres, spectral reflectances every 4 nm, the light's spectrum every 100 nm).
#include "scenes.h"
#include "spectrum.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace irradia::scenes {

namespace {

using Spectrum = std::array<float, 76>; // 400, 404, ... 700 nm

constexpr Spectrum kWhite{
    0.343f, 0.445f, 0.551f, 0.624f, 0.665f, 0.687f, 0.708f, 0.723f, 0.715f, 0.710f, 0.745f, 0.758f, 0.739f,
    0.767f, 0.777f, 0.765f, 0.751f, 0.745f, 0.748f, 0.729f, 0.745f, 0.757f, 0.753f, 0.750f, 0.746f, 0.747f,
    0.735f, 0.732f, 0.739f, 0.734f, 0.725f, 0.721f, 0.733f, 0.725f, 0.732f, 0.743f, 0.744f, 0.748f, 0.728f,
    0.716f, 0.733f, 0.726f, 0.713f, 0.740f, 0.754f, 0.764f, 0.752f, 0.736f, 0.734f, 0.741f, 0.740f, 0.732f,
    0.745f, 0.755f, 0.751f, 0.744f, 0.731f, 0.733f, 0.744f, 0.731f, 0.712f, 0.708f, 0.729f, 0.730f, 0.727f,
    0.707f, 0.703f, 0.729f, 0.750f, 0.760f, 0.751f, 0.739f, 0.724f, 0.730f, 0.740f, 0.737f};
constexpr Spectrum kGreen{
    0.092f, 0.096f, 0.098f, 0.097f, 0.098f, 0.095f, 0.095f, 0.097f, 0.095f, 0.094f, 0.097f, 0.098f, 0.096f,
    0.101f, 0.103f, 0.104f, 0.107f, 0.109f, 0.112f, 0.115f, 0.125f, 0.140f, 0.160f, 0.187f, 0.229f, 0.285f,
    0.343f, 0.390f, 0.435f, 0.464f, 0.472f, 0.476f, 0.481f, 0.462f, 0.447f, 0.441f, 0.426f, 0.406f, 0.373f,
    0.347f, 0.337f, 0.314f, 0.285f, 0.277f, 0.266f, 0.250f, 0.230f, 0.207f, 0.186f, 0.171f, 0.160f, 0.148f,
    0.141f, 0.136f, 0.130f, 0.126f, 0.123f, 0.121f, 0.122f, 0.119f, 0.114f, 0.115f, 0.117f, 0.117f, 0.118f,
    0.120f, 0.122f, 0.128f, 0.132f, 0.139f, 0.144f, 0.146f, 0.150f, 0.152f, 0.157f, 0.159f};
constexpr Spectrum kRed{
    0.040f, 0.046f, 0.048f, 0.053f, 0.049f, 0.050f, 0.053f, 0.055f, 0.057f, 0.056f, 0.059f, 0.057f, 0.061f,
    0.061f, 0.060f, 0.062f, 0.062f, 0.062f, 0.061f, 0.062f, 0.060f, 0.059f, 0.057f, 0.058f, 0.058f, 0.058f,
    0.056f, 0.055f, 0.056f, 0.059f, 0.057f, 0.055f, 0.059f, 0.059f, 0.058f, 0.059f, 0.061f, 0.061f, 0.063f,
    0.063f, 0.067f, 0.068f, 0.072f, 0.080f, 0.090f, 0.099f, 0.124f, 0.154f, 0.192f, 0.255f, 0.287f, 0.349f,
    0.402f, 0.443f, 0.487f, 0.513f, 0.558f, 0.584f, 0.620f, 0.606f, 0.609f, 0.651f, 0.612f, 0.610f, 0.650f,
    0.638f, 0.627f, 0.620f, 0.630f, 0.628f, 0.642f, 0.639f, 0.657f, 0.639f, 0.635f, 0.642f};
constexpr std::array kLight{0.0f, 8.0f, 15.6f, 18.4f}; // radiance at 400, 500, 600 and 700 nm, relative
constexpr float kLightReflectance = 0.78f;

// Counter-clockwise seen from inside the box (from outside for the blocks).
using Corners = std::array<glm::vec3, 4>;

constexpr Corners kFloor{{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}}};
constexpr Corners kCeiling{{{556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0}}};
constexpr Corners kBackWall{
    {{549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}}};
constexpr Corners kRightWall{{{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}};
constexpr Corners kLeftWall{{{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}}};
// Published in the ceiling's plane; half a millimetre lower here, so that which of the two is hit is no
// accident.
constexpr Corners kLamp{{{343, 548.3f, 227}, {343, 548.3f, 332}, {213, 548.3f, 332}, {213, 548.3f, 227}}};

const std::vector<Corners> kShortBlock{
    {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}},
    {{{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}}},
    {{{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}}},
    {{{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}}},
    {{{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}}},
};
const std::vector<Corners> kTallBlock{
    {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}},
    {{{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}}},
    {{{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}}},
    {{{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}}},
    {{{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}},
};

// Flat faces without stored normals: the measured left wall is not quite plane.
Mesh faces(const std::vector<Corners>& list) {
    Mesh mesh;
    for (const Corners& corners : list) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
        mesh.addQuad(first, first + 1, first + 2, first + 3);
    }
    return mesh;
}

} // namespace

void writeCornellBox(const std::filesystem::path& folder) {
    GlbWriter glb;
    // Lambert surfaces, as the publication assumes.
    const auto paint = [&](const char* name, const Spectrum& reflectance) {
        return glb.addMaterial(
            {.name = name, .baseColor = linearRec709(reflectance, 4.0f), .specular = 0.0f});
    };
    const int white = paint("white", kWhite), green = paint("green", kGreen), red = paint("red", kRed);
    const int lamp = glb.addMaterial({.name = "light",
                                      .baseColor = glm::vec3(kLightReflectance),
                                      .specular = 0.0f,
                                      .emission = linearRec709(kLight, 100.0f)});

    const glm::mat4 toDecimetres = scaling(glm::vec3(0.01f));
    glb.add("floor, ceiling and back wall", faces({kFloor, kCeiling, kBackWall}), white, toDecimetres);
    glb.add("right wall", faces({kRightWall}), green, toDecimetres);
    glb.add("left wall", faces({kLeftWall}), red, toDecimetres);
    glb.add("short block", faces(kShortBlock), white, toDecimetres);
    glb.add("tall block", faces(kTallBlock), white, toDecimetres);
    glb.add("light", faces({kLamp}), lamp, toDecimetres);

    // Published: film 0.025 by 0.025, focal length 0.035.
    const float fov = glm::degrees(2.0f * std::atan(0.0125f / 0.035f));
    glb.addCamera("camera", {2.78f, 2.73f, -8.0f}, {2.78f, 2.73f, 0.0f}, fov);
    glb.write(folder / "cornell-box.glb");
}

} // namespace irradia::scenes
