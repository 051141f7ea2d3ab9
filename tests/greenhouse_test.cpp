// What the greenhouse has to offer to a renderer: lamps, glass and leaves, as the loader reads them.
#include "engine/scene/load_scene.h"
#include "tests/support/closed_surface.h"

#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace irradia;

namespace {

const std::filesystem::path kFolder = IRRADIA_BIN_DIR "/../scenes";

const Scene& greenhouse() {
    static const Scene scene = loadScene(kFolder / "greenhouse.glb");
    return scene;
}

// The triangles of materials that satisfy a condition.
template <typename Condition>
Scene only(Condition condition) {
    Scene part = greenhouse();
    std::erase_if(part.triangles, [&](const Triangle& t) { return !condition(part.materials[t.material]); });
    return part;
}

template <typename Condition>
size_t countMaterials(Condition condition) {
    return static_cast<size_t>(std::ranges::count_if(greenhouse().materials, condition));
}

bool isPane(const Material& material) {
    return material.transmission > 0.0f && material.isThin;
}

bool isSolid(const Material& material) {
    return material.transmission > 0.0f && !material.isThin;
}

bool isMasked(const Material& material) {
    return material.alphaMode == AlphaMode::Mask;
}

} // namespace

TEST_CASE("The greenhouse has one lamp, a sun that shines down, and an even sky") {
    REQUIRE(greenhouse().lights.size() == 1);
    const PunctualLight& sun = greenhouse().lights[0];
    CHECK(sun.kind == PunctualLight::Kind::Directional);
    CHECK(sun.direction.y < -0.3f);
    CHECK(glm::all(glm::greaterThan(sun.intensity, glm::vec3(1.0f))));
    const Environment sky = loadEnvironment(loadCameraFile(kFolder / "greenhouse.json").environment);
    CHECK(sky.texels.empty());
    CHECK(glm::all(glm::greaterThan(sky.constant, glm::vec3(0.0f))));
    CHECK(glm::all(glm::lessThan(sky.constant, glm::vec3(1.0f))));
}

TEST_CASE("Its panes are thin sheets, clear, tinted and frosted") {
    const auto isClear = [](const Material& m) { return isPane(m) && m.roughness == 0.0f; };
    CHECK(countMaterials([&](const Material& m) { return isClear(m) && m.baseColor.b > 0.9f; }) == 1);
    CHECK(countMaterials([&](const Material& m) { return isClear(m) && m.baseColor.b < 0.9f; }) == 2);
    CHECK(countMaterials([](const Material& m) { return isPane(m) && m.roughness == 0.4f; }) == 1);
    for (const Material& material : greenhouse().materials)
        if (isPane(material)) CHECK((material.ior == 1.5f && material.transmission == 1.0f));
    CHECK(only([](const Material& m) { return isPane(m) && m.roughness > 0.0f; }).triangles.size() == 4);
}

TEST_CASE("Its carafe is solid, closed and absorbs red most") {
    REQUIRE(countMaterials(isSolid) == 1);
    const Scene carafe = only(isSolid);
    CHECK(carafe.triangles.size() > 1000);
    CHECK(unmatchedEdges(carafe) == 0);
    const glm::vec3 absorption = std::ranges::find_if(carafe.materials, isSolid)->absorption;
    CHECK(absorption.r > absorption.g);
    CHECK(absorption.g > 0.0f);
}

TEST_CASE("Its leaves are masked by the alpha of their pictures and have two sides") {
    CHECK(countMaterials(isMasked) == 2);
    CHECK(only(isMasked).triangles.size() > greenhouse().triangles.size() / 4);
    for (const Material& material : greenhouse().materials) {
        INFO(material.name);
        const bool isLeaf = material.name.ends_with("leaf");
        CHECK(isLeaf == isMasked(material));
        if (!isLeaf) continue;
        CHECK(material.doubleSided);
        REQUIRE(material.baseColorTexture.image >= 0);
        const TextureImage& image = greenhouse().images[static_cast<size_t>(material.baseColorTexture.image)];
        size_t present = 0;
        for (size_t i = 3; i < image.rgba.size(); i += 4) present += image.rgba[i] >= 128;
        const double share = static_cast<double>(present) / (static_cast<double>(image.width) * image.height);
        CHECK((share > 0.4 && share < 0.8));
    }
}

TEST_CASE("Its net is blended, and vertices have colours of their own") {
    const auto isBlended = [](const Material& m) { return m.alphaMode == AlphaMode::Blend; };
    CHECK(countMaterials(isBlended) == 1);
    CHECK(only(isBlended).triangles.size() == 960);
    size_t coloured = 0, outside = 0;
    for (const Vertex& vertex : greenhouse().vertices) {
        coloured += vertex.color != glm::vec4(1.0f);
        for (int c = 0; c < 4; c++) outside += !(vertex.color[c] >= 0.0f && vertex.color[c] <= 1.0f);
    }
    CHECK(coloured > greenhouse().vertices.size() / 2);
    CHECK(outside == 0);
}
