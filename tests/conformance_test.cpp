// Models of public test sets, from the folder conformance of the one that IRRADIA_SCENES names: each renders,
// by path tracing and with the cache, to finite numbers and without a word of the validation layers.
#include "samples/session/render_session.h"
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>

using namespace irradia;

namespace {

RenderRequest requestFor(const std::filesystem::path& model, const std::string& method) {
    RenderRequest request;
    request.scene = model.string();
    request.method = method;
    request.size = {32, 32};
    request.maxBounces = 8;
    request.environment = "0.5,0.5,0.5"; // most of them bring no light
    request.device.validation = true;
    return request;
}

// Largest value of the picture; -1 where one is not finite.
float brightest(const FilmImage& film) {
    float most = 0.0f;
    for (const glm::vec3& v : film.mean) {
        if (!std::isfinite(v.x + v.y + v.z)) return -1.0f;
        most = std::max({most, v.x, v.y, v.z});
    }
    return most;
}

} // namespace

TEST_CASE("every model of the public test sets renders") {
    const char* folder = std::getenv("IRRADIA_SCENES");
    if (!folder) SKIP("IRRADIA_SCENES is not set: models from elsewhere are not rendered");
    size_t models = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(folder) / "conformance")) {
        if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
        ++models;
        for (const char* method : {"pt", "nrc"}) {
            INFO(entry.path().filename() << " by " << method);
            RenderSession session(requestFor(entry.path(), method));
            for (uint32_t frame = 0; frame < 3; ++frame) session.renderFrame(frame);
            CHECK(brightest(session.readFilm()) > 0.0f);
            CHECK(session.device().validationMessages() == 0);
        }
    }
    CHECK(models > 0);
}
