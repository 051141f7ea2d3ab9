// The project's own scenes, as make_scenes writes them and the loader reads them.
#include "engine/image/image.h"
#include "engine/scene/load_scene.h"
#include "tests/support/closed_surface.h"

#include <algorithm>
#include <array>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <fstream>
#include <map>
#include <unistd.h>

using namespace irradia;

namespace {

// Runs make_scenes into a new folder, which goes with the object.
class GeneratedScenes {
public:
    GeneratedScenes() {
        std::string name = (std::filesystem::temp_directory_path() / "own-scenes-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        folder_ = name;
        const std::string command = IRRADIA_BIN_DIR "/make_scenes " + name;
        REQUIRE(std::system(command.c_str()) == 0);
    }
    ~GeneratedScenes() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    GeneratedScenes(const GeneratedScenes&) = delete;
    GeneratedScenes& operator=(const GeneratedScenes&) = delete;

    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_;
};

const GeneratedScenes& generated() {
    static const GeneratedScenes scenes;
    return scenes;
}

Scene load(const std::string& name) {
    return loadScene(generated().folder() / (name + ".glb"));
}

bool isEmissive(const Scene& scene, const Triangle& triangle) {
    return scene.materials[triangle.material].emission != glm::vec3(0.0f);
}

size_t emissiveTriangles(const Scene& scene) {
    return static_cast<size_t>(std::ranges::count_if(
        scene.triangles, [&](const Triangle& triangle) { return isEmissive(scene, triangle); }));
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

float brightest(glm::vec3 color) {
    return std::max({color.r, color.g, color.b});
}

// sRGB to linear, IEC 61966-2-1.
float decodeSrgb(uint8_t byte) {
    const float x = static_cast<float>(byte) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

float brightestTexel(const TextureImage& image) {
    uint8_t largest = 0;
    for (size_t i = 0; i < image.rgba.size(); i++)
        if (i % 4 != 3) largest = std::max(largest, image.rgba[i]);
    return decodeSrgb(largest);
}

// No less than the base colour a material reaches anywhere.
float largestAlbedo(const Scene& scene, size_t index) {
    const Material& material = scene.materials[index];
    const int image = material.baseColorTexture.image;
    float vertices = 0.0f;
    for (const Triangle& triangle : scene.triangles)
        for (int i = 0; triangle.material == index && i < 3; i++)
            vertices = std::max(vertices, brightest(scene.vertices[triangle.vertex[i]].color));
    return brightest(material.baseColor) * vertices *
           (image < 0 ? 1.0f : brightestTexel(scene.images[static_cast<size_t>(image)]));
}

struct Expected {
    const char* name;
    size_t triangles, emissive, cameras, lights = 0; // of those without extent
};

// Counts follow from the programs that write the scenes; the interior's lies within what its name promises.
constexpr std::array<Expected, 9> kScenes{{{"cornell-box", 32, 2, 1},
                                           {"door-room", 10042, 2, 1},
                                           {"glossy-room", 26078, 0, 1},
                                           {"lamp-gallery", 29308, 250 * 2 + 250 * 8, 2},
                                           {"mixed-lamps", 25774, 166, 2, 334},
                                           {"mixed-lamp", 25774, 0, 2, 1},
                                           {"interior", 104230, 322, 2},
                                           {"greenhouse", 50965, 0, 1, 1},
                                           {"furnace-sphere", 5120, 5120, 1}}};

} // namespace

TEST_CASE("Own scenes load without a warning or a dropped triangle, with the counts they are made for") {
    for (const Expected& expected : kScenes) {
        INFO(expected.name);
        const Scene scene = load(expected.name);
        CHECK(scene.triangles.size() == expected.triangles);
        CHECK(emissiveTriangles(scene) == expected.emissive);
        CHECK(scene.cameras.size() == expected.cameras);
        CHECK(scene.lights.size() == expected.lights);
        CHECK(scene.notes.degenerateTriangles == 0);
        CHECK(scene.notes.nonFiniteTriangles == 0);
        CHECK(scene.notes.warnings == std::vector<std::string>{});
    }
}

TEST_CASE("Surfaces reflect at most 95 %, lamps emit from one side, shading normals agree with faces") {
    for (const Expected& expected : kScenes) {
        INFO(expected.name);
        const Scene scene = load(expected.name);
        for (size_t i = 0; i < scene.materials.size(); i++) {
            const Material& material = scene.materials[i];
            INFO(material.name);
            if (material.isThin) CHECK(largestAlbedo(scene, i) <= 0.95f); // solid glass absorbs inside
            if (material.emission != glm::vec3(0.0f)) CHECK_FALSE(material.doubleSided);
        }
        size_t against = 0;
        for (const Triangle& triangle : scene.triangles) {
            const auto [a, b, c] = corners(scene, triangle);
            const glm::vec3 face = glm::normalize(glm::cross(b - a, c - a));
            for (int i = 0; i < 3; i++) // within 60 degrees
                against += glm::dot(face, scene.vertices[triangle.vertex[i]].normal) < 0.5f;
        }
        CHECK(against == 0);
    }
}

TEST_CASE("The furnace sphere is closed and faces inwards, with albedo and emission 1/2") {
    const Scene scene = load("furnace-sphere");
    CHECK(unmatchedEdges(scene) == 0);
    size_t outwards = 0, offSphere = 0;
    for (const Triangle& triangle : scene.triangles) {
        const auto [a, b, c] = corners(scene, triangle);
        outwards += glm::dot(glm::cross(b - a, c - a), a + b + c) >= 0.0f;
        for (glm::vec3 p : {a, b, c}) offSphere += std::abs(glm::length(p) - 1.0f) > 1e-6f;
    }
    CHECK(outwards == 0);
    CHECK(offSphere == 0);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].baseColor == glm::vec3(0.5f));
    CHECK(scene.materials[0].emission == glm::vec3(0.5f));
    CHECK(scene.materials[0].specular == 0.0f);

    Scene holed = scene; // the check of closedness finds one missing triangle, and one turned over
    holed.triangles.pop_back();
    CHECK(unmatchedEdges(holed) == 3);
    std::swap(holed.triangles[0].vertex[0], holed.triangles[0].vertex[1]);
    CHECK(unmatchedEdges(holed) == 6);
}

TEST_CASE("The door room's lamp looks away from the camera's room") {
    const Scene scene = load("door-room");
    REQUIRE(scene.cameras[0].position.x < 0.0f);
    for (const Triangle& triangle : scene.triangles) {
        if (!isEmissive(scene, triangle)) continue;
        const auto [a, b, c] = corners(scene, triangle);
        CHECK(std::min({a.x, b.x, c.x}) > 0.0f);
        CHECK(glm::normalize(glm::cross(b - a, c - a)).x == Catch::Approx(1.0f));
    }
}

TEST_CASE("The Cornell box has its published extent and colours near the usual ones") {
    const Scene scene = load("cornell-box");
    const Bounds bounds = sceneBounds(scene);
    CHECK(bounds.lower == glm::vec3(0.0f));
    CHECK(bounds.upper.x == Catch::Approx(5.56f));
    CHECK(bounds.upper.y == Catch::Approx(5.488f));
    CHECK(bounds.upper.z == Catch::Approx(5.592f));
    CHECK(glm::degrees(scene.cameras[0].verticalFov) == Catch::Approx(39.3077f));
    std::map<std::string, glm::vec3> colors;
    for (const Material& material : scene.materials) {
        colors[material.name] = material.baseColor;
        CHECK(material.specular == 0.0f);
    }
    // The spectra's values at their plateaus bound what any conversion may give.
    for (float channel : {colors["white"].r, colors["white"].g, colors["white"].b})
        CHECK((channel > 0.70f && channel < 0.777f));
    CHECK((colors["green"].g > 0.3f && colors["green"].r < 0.15f && colors["green"].b < 0.15f));
    CHECK((colors["red"].r > 0.4f && colors["red"].g < 0.07f && colors["red"].b < 0.07f));
}

// What the camera file beside a scene names; it holds the scene's own camera.
static std::string environmentBeside(const std::string& name, const Scene& scene) {
    const CameraFile file = loadCameraFile(generated().folder() / (name + ".json"));
    CHECK(glm::distance(file.camera.position, scene.cameras[0].position) < 1e-5f);
    CHECK(glm::dot(file.camera.forward, scene.cameras[0].forward) == Catch::Approx(1.0f));
    CHECK(file.camera.verticalFov == Catch::Approx(scene.cameras[0].verticalFov));
    return file.environment;
}

TEST_CASE("The glossy room's camera file agrees with its camera and brings its sky") {
    const Scene scene = load("glossy-room");
    const Environment sky = loadEnvironment(environmentBeside("glossy-room", scene));
    REQUIRE(sky.texels.size() == 256 * 128);
    for (const glm::vec3& texel : sky.texels)
        REQUIRE((glm::all(glm::greaterThan(texel, glm::vec3(0.0f))) && brightest(texel) < 200.0f));

    std::vector<float> roughness;
    for (const Material& material : scene.materials)
        if (material.metallic == 1.0f && material.baseColorTexture.image < 0)
            roughness.push_back(material.roughness);
    CHECK(roughness == std::vector<float>{0.05f, 0.1f, 0.2f, 0.35f, 0.5f});
}

TEST_CASE("make_scenes writes the same bytes again") {
    const GeneratedScenes again;
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(generated().folder())) {
        INFO(entry.path().filename());
        const std::string bytes = bytesOf(entry.path());
        CHECK_FALSE(bytes.empty());
        CHECK((bytes == bytesOf(again.folder() / entry.path().filename())));
        files++;
    }
    CHECK(files == 12); // nine scenes, a sky and two camera files
}
