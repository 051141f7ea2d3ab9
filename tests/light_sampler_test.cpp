// Another way to choose light samples is one file of shaders and a line that names the kernels compiled with
// it: it renders the same picture.
#include "kernels/path.h"
#include "kernels/shaders.h"
#include "tests/reference/simple_scenes.h"
#include "tests/reference/z_test.h"
#include "tests/support/gpu_render.h"
#include "tests/support/light_scenes.h"
#include "tests/support/validated_device.h"
#include <catch2/catch_test_macros.hpp>

using namespace irradia;

namespace {

Device& device() {
    return test::deviceWith(QuadAccess::Texel);
}

// tests/shaders/uniform_lights.
const VertexKernels kUniformLights{
    &kernels::handle_escaped_rays_uniform_lights, &kernels::handle_emissive_hits_uniform_lights,
    &kernels::scatter_uniform_lights, &kernels::add_direct_light, &kernels::add_filtered_light};

// Triangles that give light and reflect it, under a sky with a sun, and lights of all other kinds; seen from
// among them.
struct Lit {
    Lit() {
        scene = test::manyEmitters(5);
        test::addPunctualLights(scene, 1, 1, 1); // fewer local lights than the hierarchy begins with
        scene.environment = test::skyWithSun(16, 8);
        camera.position = glm::vec3(0.0f);
        camera.forward = glm::vec3(0, 0, -1);
        camera.up = glm::vec3(0, 1, 0);
        camera.verticalFov = 2.2f;
    }
    Scene scene;
    Camera camera;
};

PathTracerOptions options() {
    PathTracerOptions options;
    options.width = options.height = 24;
    options.maxBounces = 3;
    options.samplesPerFrame = 16;
    return options;
}

} // namespace

TEST_CASE("a light sampler is a file: lights chosen uniformly give the same picture, with other noise") {
    Lit lit;
    test::GpuRenderer renderer(device(), lit.scene);
    PathTracerOptions uniform = options();
    uniform.kernels = kUniformLights;
    uniform.seed = 2; // independent of the other
    const FilmImage shipped = renderer.render(lit.camera, options(), 64);
    const FilmImage other = renderer.render(lit.camera, uniform, 64);
    const reference::ZTestResult result =
        reference::zTest(test::toEstimate(other), test::toEstimate(shipped));
    INFO(result.summary());
    CHECK(result.accepted());

    uniform.seed = options().seed; // the same random numbers choose other lights
    CHECK(renderer.render(lit.camera, uniform, 1).mean != renderer.render(lit.camera, options(), 1).mean);

    auto brighter = test::toEstimate(other); // a chance off by 5 % must be seen
    for (auto& mean : brighter.mean) mean *= 1.05;
    for (auto& variance : brighter.variance) variance *= 1.05 * 1.05;
    CHECK_FALSE(reference::zTest(brighter, test::toEstimate(shipped)).accepted());
    CHECK(device().validationMessages() == 0);
}
