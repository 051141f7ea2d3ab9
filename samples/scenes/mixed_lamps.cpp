// The gallery under 500 small lamps of three kinds in turn, points, spots and emissive triangles, half in its
// ceiling and half in its air; and the same with one of them alone, the others dark, to compare what they
// cost.
#include "gallery.h"
#include "random.h"
#include "scenes.h"

#include <array>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace irradia::scenes {

namespace {

constexpr uint32_t kLamps = 500, kAlong = 25, kAcross = 10;
constexpr float kSide = 0.12f; // of the triangles' two shorter sides

constexpr size_t kColors = 4, kIntensities = 4;
constexpr std::array<glm::vec3, kColors> kLampColors{
    {{1.0f, 0.85f, 0.65f}, {1.0f, 0.6f, 0.3f}, {0.5f, 0.75f, 1.0f}, {0.9f, 0.95f, 1.0f}}};

// A lamp's index is that of its colour and intensity.
class Lamps {
public:
    Lamps(GlbWriter& glb, uint32_t lit)
        : glb_(glb)
        , lit_(lit) {
        const Mesh triangle{.positions = {{0, 0, 0}, {kSide, 0, 0}, {0, 0, kSide}},
                            .normals = std::vector(3, glm::vec3(0, -1, 0)),
                            .indices = {0, 1, 2}};
        const int dark = glb.addMaterial({.name = "dark", .baseColor = glm::vec3(0.0f)});
        dark_ = glb.addMesh("dark", triangle, dark);
        for (const float intensity : std::array<float, kIntensities>{0.02f, 0.06f, 0.15f, 0.4f})
            for (const glm::vec3& color : kLampColors) {
                points_.push_back(glb.addLight({.color = color, .intensity = intensity}));
                for (const float outer : {25.0f, 45.0f, 70.0f})
                    spots_.push_back(glb.addLight({.color = color,
                                                   .intensity = intensity,
                                                   .cone = glm::radians(glm::vec2(0.6f * outer, outer))}));
                const float radiance = intensity / (0.5f * kSide * kSide);
                const int material = glb.addMaterial(
                    {.name = "lamp", .baseColor = glm::vec3(0.0f), .emission = radiance * color});
                triangles_.push_back(glb.addMesh("triangle", triangle, material));
            }
    }

    void add(uint32_t number, const glm::vec3& at, Random& random) {
        const auto any = [&](const std::vector<int>& list) {
            return list[static_cast<size_t>(random.between(0.0f, static_cast<float>(list.size())))];
        };
        const int point = any(points_), spot = any(spots_), triangle = any(triangles_);
        const glm::vec3 target =
            at + glm::vec3(random.between(-1.0f, 1.0f), -1.5f, random.between(-1.0f, 1.0f));
        const bool isLit = number < lit_;
        if (number % 3 == 0 && isLit) glb_.addLightNode("point", point, translation(at));
        if (number % 3 == 1 && isLit)
            glb_.addLightNode("spot", spot,
                              glm::affineInverse(glm::lookAt(at, target, glm::vec3(1.0f, 0.0f, 0.0f))));
        if (number % 3 == 2) glb_.addNode("triangle", isLit ? triangle : dark_, translation(at));
    }

private:
    GlbWriter& glb_;
    uint32_t lit_; // the first ones
    int dark_;
    std::vector<int> points_, spots_, triangles_;
};

// The first is a point in the middle of the room.
void writeGallery(const std::filesystem::path& file, uint32_t lit) {
    GlbWriter glb;
    addGalleryShell(glb);
    Lamps lamps(glb, lit);
    Random random(501);
    lamps.add(0, {0.0f, 3.0f, 0.0f}, random);
    for (uint32_t i = 1; i < kLamps; i++) {
        const uint32_t place = i / 2;
        const float x = spread(place / kAcross, kAlong, kGallery.lower.x, kGallery.upper.x);
        const float z = spread(place % kAcross, kAcross, kGallery.lower.z, kGallery.upper.z);
        const float y = i % 2 == 0 ? kGallery.upper.y - 0.1f : random.between(1.9f, 3.2f);
        lamps.add(i, {x, y, z}, random);
    }
    addGalleryExhibits(glb);
    addGalleryCameras(glb);
    glb.write(file);
}

} // namespace

void writeMixedLamps(const std::filesystem::path& folder) {
    writeGallery(folder / "mixed-lamps.glb", kLamps);
    writeGallery(folder / "mixed-lamp.glb", 1);
}

} // namespace irradia::scenes
