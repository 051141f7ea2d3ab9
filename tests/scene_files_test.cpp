// Scenes nobody here made, from the folder IRRADIA_SCENES names; without it this suite is skipped.
#include "engine/scene/load_scene.h"
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <map>

using namespace irradia;

namespace {

std::filesystem::path scenesFolder() {
    const char* folder = std::getenv("IRRADIA_SCENES");
    if (!folder) SKIP("IRRADIA_SCENES is not set: scenes from elsewhere are not tested");
    return folder;
}

bool isUnit(glm::vec3 v) {
    return std::abs(glm::length(v) - 1.0f) < 1e-5f;
} // of float components

// What every consumer of a scene relies on.
void checkInvariants(const Scene& scene) {
    size_t badIndex = 0, badMaterial = 0, badNormal = 0, badTangent = 0, badPosition = 0;
    for (const Triangle& triangle : scene.triangles) {
        for (int c = 0; c < 3; ++c) badIndex += triangle.vertex[c] >= scene.vertices.size();
        badMaterial += triangle.material >= scene.materials.size();
    }
    for (const Vertex& vertex : scene.vertices) {
        const glm::vec3 tangent(vertex.tangent);
        badPosition += !std::isfinite(glm::dot(vertex.position, vertex.position));
        badNormal += !isUnit(vertex.normal);
        badTangent += vertex.tangent != glm::vec4(0.0f) &&
                      !(isUnit(tangent) && std::abs(glm::dot(tangent, vertex.normal)) < 1e-5f &&
                        std::abs(vertex.tangent.w) == 1.0f);
    }
    CHECK(badIndex == 0);
    CHECK(badMaterial == 0);
    CHECK(badPosition == 0);
    CHECK(badNormal == 0);
    CHECK(badTangent == 0);
}

bool isScene(const std::filesystem::path& file) {
    return file.extension() == ".glb" || file.extension() == ".gltf";
}

Scene loadAndPrint(const std::filesystem::path& file) {
    const auto begin = std::chrono::steady_clock::now();
    Scene scene = loadScene(file);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    fmt::print("{:28} {:7} triangles {:7} vertices {:2} pictures {:6.0f} ms\n", file.filename().string(),
               scene.triangles.size(), scene.vertices.size(), scene.images.size(), elapsed.count());
    for (const std::string& warning : scene.notes.warnings) fmt::print("    {}\n", warning);
    return scene;
}

} // namespace

TEST_CASE("Real scenes load with the triangles their files state") {
    const std::map<std::string, size_t> triangles{{"cornell-box", 32},         {"cornell-lambert", 32},
                                                  {"cornell-animated", 32},    {"veach-ajar", 382690},
                                                  {"veach-ajar-door", 382690}, {"veach-mis", 4812},
                                                  {"living-room", 143163},     {"jungle", 18515}};
    const auto folder = scenesFolder();
    for (const auto& [name, count] : triangles) {
        CAPTURE(name);
        const Scene scene = loadAndPrint(folder / (name + ".glb"));
        const SceneNotes& notes = scene.notes;
        CHECK(scene.triangles.size() + notes.degenerateTriangles + notes.nonFiniteTriangles == count);
        checkInvariants(scene);
        const CameraFile file = chooseCamera(scene, (folder / (name + ".json")).string());
        CHECK(std::abs(glm::dot(file.camera.forward, file.camera.up)) < 1e-6f);
        if (!file.environment.empty()) CHECK_FALSE(loadEnvironment(file.environment).isBlack());
    }
}

TEST_CASE("Conformance models load") {
    for (const auto& entry : std::filesystem::directory_iterator(scenesFolder() / "conformance")) {
        if (!isScene(entry.path())) continue;
        CAPTURE(entry.path());
        const Scene scene = loadAndPrint(entry.path());
        CHECK_FALSE(scene.triangles.empty());
        checkInvariants(scene);
    }
}
