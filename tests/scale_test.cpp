// Worlds of any size and place: a square lamp over a Lambert receiver has one radiance, in closed form,
// whatever the unit, the place and what else stands in the scene.
#include "engine/scene/load_scene.h"
#include "tests/gltf_builder.h"
#include "tests/support/gpu_render.h"
#include "tests/support/kernel_harness.h"
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

using namespace irradia;
using namespace irradia::test;

namespace {

// Nodes of unit squares that face +Z, under one root node.
class World {
public:
    explicit World(const Json& root) {
        file_.root(root);
        file_.json["nodes"][0]["children"] = Json::array();
        for (const bool isLamp : {false, true}) {
            Json material{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};
            material["pbrMetallicRoughness"]["baseColorFactor"] =
                isLamp ? Json{0, 0, 0, 1} : Json{0.5, 0.5, 0.5, 1};
            if (isLamp) material["emissiveFactor"] = {1, 1, 1};
            file_.json["materials"].push_back(material);
        }
        const int positions = file_.vec3({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
        const int indices = file_.indices({0, 1, 2, 0, 2, 3});
        for (int material : {0, 1})
            file_.json["meshes"].push_back({{"primitives",
                                             {{{"attributes", {{"POSITION", positions}}},
                                               {"indices", indices},
                                               {"material", material}}}}});
    }

    static constexpr int kSurface = 0, kLamp = 1; // what addSquare adds

    void addSquare(int mesh, const Json& rotation, const glm::dvec3& at, double halfWidth) {
        child({{"mesh", mesh},
               {"rotation", rotation},
               {"translation", {at.x, at.y, at.z}},
               {"scale", {halfWidth, halfWidth, halfWidth}}});
    }

    void addCamera(const Json& rotation, const glm::dvec3& at, double fov) {
        file_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", fov}, {"znear", 0.1}}}}};
        child({{"camera", 0}, {"rotation", rotation}, {"translation", {at.x, at.y, at.z}}});
    }

    Scene load() const {
        const TempFolder folder;
        return loadScene(folder.write("world.glb", file_.glb()));
    }

private:
    void child(const Json& node) {
        file_.json["nodes"].push_back(node);
        file_.json["nodes"][0]["children"].push_back(file_.json["nodes"].size() - 1);
    }

    GltfBuilder file_;
};

const double kHalf = std::sqrt(0.5);
const Json kUp{-kHalf, 0, 0, kHalf}, kDown{kHalf, 0, 0, kHalf}, kFront{0, 0, 0, 1};

// No axis of the world is one of the scene's: coordinates have all their digits.
Json turned(const glm::dvec3& at = {}, double scale = 1.0) {
    return {{"rotation", {0.18257418583505536, 0.3651483716701107, 0.5477225575051661, 0.7302967433402214}},
            {"translation", {at.x, at.y, at.z}},
            {"scale", {scale, scale, scale}}};
}

// A lamp of 2 x 2 and radiance 1, 2 above the middle of a receiver, which a camera between them sees.
World lampOver(const Json& root, double receiverHalfWidth = 0.2, double cameraHeight = 1.0) {
    World world(root);
    world.addSquare(World::kSurface, kUp, {0, 0, 0}, receiverHalfWidth);
    world.addSquare(World::kLamp, kDown, {0, 2, 0}, 1.0);
    world.addCamera(kUp, {0, cameraHeight, 0}, 0.02);
    return world;
}

// Albedo times the form factor from a small area to a parallel square over it (Howell, "A Catalog of
// Radiation Heat Transfer Configuration Factors", B-4): four times that to a quarter of it.
double closedForm() {
    const double x = 0.5, root = std::sqrt(1.0 + x * x);
    return 0.5 * 4.0 * (1.0 / std::numbers::pi) * x / root * std::atan(x / root);
}

FilmImage render(const Scene& scene) {
    PathTracerOptions options;
    options.width = options.height = 16;
    options.maxBounces = 0;
    options.layers = true;
    return GpuRenderer(validatedDevice(), scene).render(scene.cameras.at(0), options, 64);
}

double radiance(const Scene& scene) {
    double sum = 0.0;
    const FilmImage film = render(scene);
    for (const glm::vec3& v : film.mean) sum += double(v.x);
    return sum / double(film.mean.size());
}

// Of 16,384 paths' mean, by one light sample each, whose values differ by less than a factor of 1.6: six
// sigma.
constexpr double kTolerance = 0.01;

bool isClosedForm(const Scene& scene) {
    const double found = radiance(scene);
    UNSCOPED_INFO("radiance " << found << ", closed form " << closedForm());
    return std::abs(found / closedForm() - 1.0) < kTolerance;
}

} // namespace

TEST_CASE("the radiance under a lamp does not depend on the unit of length") {
    CHECK(std::abs(closedForm() - 0.11973) < 1e-5);
    for (const double scale : {1e-4, 1e-2, 1.0, 1e3, 1e6}) {
        INFO("scale " << scale);
        CHECK(isClosedForm(lampOver(turned({}, scale)).load()));
    }
}

TEST_CASE("nor on the place, which a node may put 1,000 km off") {
    for (const glm::dvec3& at : {glm::dvec3(1e6, 0, 0), glm::dvec3(-3e5, 1e6, 7e5)}) {
        INFO("at " << at.x << " " << at.y << " " << at.z);
        const Scene scene = lampOver(turned(at)).load();
        CHECK(isClosedForm(scene));
        // Positions are the file's all the same, to the half ulp of a float of 1e6.
        const FilmImage film = render(scene);
        const glm::vec3& seen = film.position.at(8 * 16 + 8);
        for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(double(seen[axis]) - at[axis]) < 0.05);
    }
    CHECK(isClosedForm(lampOver(turned({1e6, 1e6, 1e6}, 1e-2)).load()));
}

TEST_CASE("nor on what stands far off, or lies below") {
    for (const double distance : {1e4, 1e5}) {
        INFO("distance " << distance);
        World stray = lampOver(turned());
        stray.addSquare(World::kSurface, kFront, {0, -distance, 0.01 * distance}, 0.01);
        CHECK(isClosedForm(stray.load()));
        World both = lampOver(turned({1e6, 0, 0}));
        both.addSquare(World::kSurface, kFront, {0, -distance, 0.01 * distance}, 0.01);
        CHECK(isClosedForm(both.load()));
        World ground = lampOver(turned());
        ground.addSquare(World::kSurface, kUp, {0, -0.05, 0}, distance);
        CHECK(isClosedForm(ground.load()));
    }
}

TEST_CASE("a plate just above its receiver shades it, and the receiver does not shade itself") {
    struct Case {
        double gap, receiver, backdrop; // half widths
    };
    for (const Case& c : {Case{0.005, 3.0, 1e3}, Case{0.005, 3.0, 1e5}, Case{0.03, 5e3, 1.0}}) {
        INFO("gap " << c.gap << ", receiver " << c.receiver << ", backdrop " << c.backdrop);
        World world = lampOver(turned(), c.receiver, 0.5 * c.gap);
        world.addSquare(World::kSurface, kFront, {0, 0, -c.backdrop}, c.backdrop);
        CHECK(isClosedForm(world.load()));
        world.addSquare(World::kSurface, kUp, {0, c.gap, 0}, 0.3);
        CHECK(radiance(world.load()) == 0.0);
    }
}

TEST_CASE("a plate just below a lamp shades what lies far below both") {
    World world(turned());
    world.addSquare(World::kSurface, kUp, {0, 0, 0}, 3.0);
    world.addSquare(World::kLamp, kDown, {0, 100, 0}, 1.0);
    world.addSquare(World::kSurface, kUp, {0, 99.995, 0}, 1.2);
    world.addCamera(kUp, {0, 1, 0}, 0.02);
    CHECK(radiance(world.load()) == 0.0);
}

TEST_CASE("no pass had anything to say against it") {
    CHECK(validatedDevice().validationMessages() == 0);
}
