// EXT_texture_webp, pictures made here by the library that reads them: whole, cut short, and with sizes that
// lie.
#include "tests/support/compressed_files.h"
#include "tests/support/expect_error.h"
#include <webp/encode.h>

using namespace irradia;
using namespace irradia::test;

namespace {

Bytes webp(int width, int height, bool isLossless, const std::vector<uint8_t>& rgba) {
    uint8_t* encoded = nullptr;
    const size_t size = isLossless ? WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &encoded)
                                   : WebPEncodeRGBA(rgba.data(), width, height, 4 * width, 100, &encoded);
    const Bytes bytes(encoded, encoded + size);
    WebPFree(encoded);
    return bytes;
}

GltfBuilder webpScene(const Bytes& data) {
    GltfBuilder builder;
    builder.mesh(
        {{"attributes", {{"POSITION", builder.vec3(kTriangle)}, {"TEXCOORD_0", builder.vec2(kTriangleUv)}}},
         {"material", 0}});
    builder.json["images"] = {{{"bufferView", builder.view(data)}, {"mimeType", "image/webp"}}};
    builder.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    builder.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    return builder;
}

} // namespace

TEST_CASE("WebP pictures, lossless and lossy, in place of a texture's source") {
    const std::vector<uint8_t> texels{255, 0, 0, 255, 0, 0, 255, 128};
    GltfBuilder builder = webpScene(webp(2, 1, true, texels));
    const Scene scene = load(builder);
    CHECK(scene.notes.warnings.empty());
    REQUIRE(scene.images.size() == 1);
    CHECK(scene.images[0].width == 2);
    CHECK(scene.images[0].rgba == texels);

    const Scene lossy = load(webpScene(webp(8, 8, false, std::vector<uint8_t>(256, 200))));
    CHECK(lossy.images[0].rgba.size() == 256);
    CHECK(std::abs(lossy.images[0].rgba[0] - 200) <= 2);

    builder.json["images"].push_back({{"uri", "gone.png"}}); // for those who do not read WebP
    builder.json["textures"][0]["source"] = 1;
    CHECK(load(builder).images[0].rgba == texels);
    builder.json["textures"][0] = {{"source", 0}}; // without the extension, as some write it
    CHECK(load(builder).images[0].rgba == texels);
}

TEST_CASE("WebP cut short, moving, too large, or not there") {
    std::vector<uint8_t> noise(64 * 64 * 4);
    std::mt19937 random(3);
    for (uint8_t& value : noise) value = static_cast<uint8_t>(random());
    for (const bool isLossless : {true, false}) {
        const Bytes whole = webp(64, 64, isLossless, noise);
        for (size_t size = 12; size < whole.size() - 64; size += whole.size() / 20) {
            CAPTURE(isLossless, size);
            const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            expectError(ExitCode::BadData, "image 0", [&] { load(webpScene(cut)); });
        }
    }
    // An extended header that claims to move, and one of 16,384 x 16,384 pixels.
    const auto extended = [](uint8_t flags, uint8_t high) {
        Bytes bytes{'R', 'I', 'F', 'F', 22, 0, 0, 0, 'W', 'E', 'B', 'P', 'V', 'P', '8', 'X', 10, 0, 0, 0};
        bytes.insert(bytes.end(), {flags, 0, 0, 0, 255, high, 0, 255, high, 0});
        return bytes;
    };
    expectError(ExitCode::BadData, "WebP", [&] { load(webpScene(extended(2, 0))); });
    expectError(ExitCode::BadData, "image 0", [&] { load(webpScene(extended(0, 63))); });
    const Bytes wide = webp(16383, 4097, true, std::vector<uint8_t>(size_t{16383} * 4097 * 4, 7));
    CHECK(wide.size() < 100000);
    expectError(ExitCode::BadData, "16383 x 4097 pixels are more than the", [&] { load(webpScene(wide)); });

    GltfBuilder builder = webpScene(webp(2, 1, true, std::vector<uint8_t>(8, 9)));
    builder.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 4;
    expectError(ExitCode::BadData, "texture 0: UNRESOLVED_REFERENCE: image 4 of 1", [&] { load(builder); });
    checkDamage(webpScene(webp(64, 64, true, noise)).glb(), 100);
}
