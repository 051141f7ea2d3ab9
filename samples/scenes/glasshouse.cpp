#include "glasshouse.h"

#include "primitives.h"

#include <array>

namespace irradia::scenes {

namespace {

constexpr uint32_t kBays = 10, kGableBays = 5, kRows = 3; // along z, along x, up the roof

float step(float from, float to, uint32_t i, uint32_t n) {
    return from + (to - from) * static_cast<float>(i) / static_cast<float>(n);
}

// A bar of square section whose middle runs between two points.
void addBar(Mesh& frame, glm::vec3 from, glm::vec3 to, float halfWidth) {
    const float length = glm::distance(from, to);
    frame.append(box({-halfWidth, -halfWidth, -halfWidth}, {halfWidth, length + halfWidth, halfWidth}),
                 standing(from, to));
}

class Glazier {
public:
    Glazier(const LeanTo& house, const LeanToMaterials& materials)
        : house_(house)
        , materials_(materials) {}

    void glazeSide();
    void glazeRoof();
    void glazeGable();
    void add(GlbWriter& glb) const;

private:
    // Panes meet in the middle of bars.
    void addPane(int glass, const std::array<glm::vec3, 4>& corners) { meshOf(glass).addFlatQuad(corners); }
    Mesh& meshOf(int glass);

    const LeanTo& house_;
    const LeanToMaterials& materials_;
    Mesh bars_, clear_, green_, amber_, frosted_;
};

Mesh& Glazier::meshOf(int glass) {
    if (glass == materials_.green) return green_;
    if (glass == materials_.amber) return amber_;
    return glass == materials_.frosted ? frosted_ : clear_;
}

void Glazier::glazeSide() {
    const float x = house_.lower.x, middle = 0.5f * (house_.plinth + house_.eave);
    for (uint32_t i = 0; i < kBays; i++) {
        const float z0 = step(house_.lower.z, house_.upper.z, i, kBays);
        const float z1 = step(house_.lower.z, house_.upper.z, i + 1, kBays);
        const auto add = [&](int glass, float y0, float y1) {
            addPane(glass, {{{x, y0, z1}, {x, y0, z0}, {x, y1, z0}, {x, y1, z1}}});
        };
        add(materials_.clear, house_.plinth, middle);
        add(i == 3   ? materials_.frosted
            : i == 4 ? materials_.amber
            : i == 1 ? materials_.green
                     : materials_.clear,
            middle, house_.eave);
        addBar(bars_, {x, house_.plinth, z0}, {x, house_.eave, z0}, 0.025f);
    }
    for (float y : {house_.plinth, middle, house_.eave})
        addBar(bars_, {x, y, house_.lower.z}, {x, y, house_.upper.z}, y == middle ? 0.018f : 0.035f);
}

void Glazier::glazeRoof() {
    const auto at = [&](uint32_t bay, uint32_t row) {
        const float x = step(house_.lower.x, house_.upper.x, row, kRows);
        return glm::vec3(x, house_.roof(x), step(house_.lower.z, house_.upper.z, bay, kBays));
    };
    for (uint32_t i = 0; i < kBays; i++) {
        for (uint32_t row = 0; row < kRows; row++) {
            const int lowest = i == 8 ? materials_.frosted : materials_.clear;
            addPane(row == 0 ? lowest : materials_.clear,
                    {at(i + 1, row), at(i + 1, row + 1), at(i, row + 1), at(i, row)});
        }
        addBar(bars_, at(i, 0), at(i, kRows), 0.022f);
    }
    for (uint32_t row = 1; row <= kRows; row++) addBar(bars_, at(0, row), at(kBays, row), 0.028f);
}

void Glazier::glazeGable() {
    const float z = house_.lower.z, middle = 0.5f * (house_.plinth + house_.eave);
    for (uint32_t i = 0; i <= kGableBays; i++) {
        const float x0 = step(house_.lower.x, house_.upper.x, i, kGableBays);
        addBar(bars_, {x0, house_.plinth, z}, {x0, house_.roof(x0), z}, 0.025f);
        if (i == kGableBays) break;
        const float x1 = step(house_.lower.x, house_.upper.x, i + 1, kGableBays);
        const auto add = [&](int glass, float y, float left, float right) {
            addPane(glass, {{{x0, y, z}, {x1, y, z}, {x1, right, z}, {x0, left, z}}});
        };
        add(materials_.clear, house_.plinth, middle, middle);
        add(i == 1   ? materials_.amber
            : i == 3 ? materials_.green
                     : materials_.clear,
            middle, house_.eave, house_.eave);
        add(materials_.clear, house_.eave, house_.roof(x0), house_.roof(x1));
    }
    for (float y : {house_.plinth, middle, house_.eave})
        addBar(bars_, {house_.lower.x, y, z}, {house_.upper.x, y, z}, 0.025f);
}

void Glazier::add(GlbWriter& glb) const {
    glb.add("bars", bars_, materials_.frame);
    glb.add("panes", clear_, materials_.clear);
    glb.add("green panes", green_, materials_.green);
    glb.add("amber panes", amber_, materials_.amber);
    glb.add("frosted panes", frosted_, materials_.frosted);
}

} // namespace

void addLeanTo(GlbWriter& glb, const LeanTo& house, const LeanToMaterials& materials) {
    const glm::vec3 lower = house.lower, upper = house.upper;
    const float thickness = 0.2f, below = lower.y - thickness, above = upper.y + 0.3f;
    glb.add("slab", box({lower.x - thickness, below, lower.z - thickness}, {upper.x, lower.y, upper.z}),
            materials.plinth);
    glb.add("side plinth",
            box({lower.x - 0.12f, below, lower.z - 0.1f}, {lower.x + 0.08f, house.plinth, upper.z + 0.1f}),
            materials.plinth);
    glb.add("gable plinth",
            box({lower.x, below, lower.z - 0.12f}, {upper.x + 0.1f, house.plinth - 0.002f, lower.z + 0.08f}),
            materials.plinth);
    glb.add("wall +z", box({lower.x - 0.1f, below, upper.z}, {upper.x + 0.1f, above, upper.z + thickness}),
            materials.wall);
    glb.add("wall +x", box({upper.x, below, lower.z - 1.0f}, {upper.x + thickness, above, upper.z + 0.1f}),
            materials.wall);
    // Bricks, 0.24 long, just before the wall.
    glb.add("bricks",
            quad({upper.x - 0.002f, lower.y - 0.02f, lower.z - 0.1f}, {0.0f, 0.0f, upper.z - lower.z + 0.12f},
                 {0.0f, upper.y - lower.y + 0.02f, 0.0f}, {6.5f, 4.5f}),
            materials.bricks);
    Glazier glazier(house, materials);
    glazier.glazeSide();
    glazier.glazeRoof();
    glazier.glazeGable();
    glazier.add(glb);
}

} // namespace irradia::scenes
