#include "nrc/samplers/tile_paths.h"

#include <algorithm>
#include <cmath>

namespace irradia {

TilePaths::TilePaths(uint32_t width, uint32_t height, uint32_t most)
    : width_(width)
    , height_(height)
    , most_(most)
    , mostTiles_(std::min(most, width * height)) {}

// Of its own pixels' share and, with those that lie in it by a part, of four rows of tiles.
uint32_t TilePaths::mostPixelsOfWave(uint64_t bindingBytes) const {
    const uint64_t bound = bindingBytes / gpu::kVertexBytes - gpu::kTileRows;
    const uint64_t rows = 4 * std::min<uint64_t>(width_, mostTiles_);
    return static_cast<uint32_t>(
        std::min<uint64_t>((bound - rows) * (uint64_t{width_} * height_) / mostTiles_, UINT32_MAX));
}

void TilePaths::choose(double paths) {
    const double width = width_, height = height_, most = mostTiles_;
    const double camera = std::clamp(paths, 1.0, double(most_));
    const double tiles = std::min(camera, most);
    const double x = std::clamp(std::floor(std::sqrt(tiles * width / height)), 1.0, std::min(width, most));
    const double y = std::clamp(std::floor(tiles / x), 1.0, std::min(height, std::floor(most / x)));
    tilesX_ = static_cast<uint32_t>(x);
    tilesY_ = static_cast<uint32_t>(y);
    unseen_ = static_cast<uint32_t>(camera > width * height ? camera - x * y : 0.0);
}

void TilePaths::setTiles(gpu::CacheRule& rule) const {
    rule.tilesX = tilesX_;
    rule.tilesY = tilesY_;
}

RowRange TilePaths::touchedBy(const Wave& wave) const {
    const auto tileRow = [&](uint32_t pixel) { return pixel / width_ * tilesY_ / height_; };
    const uint32_t first = tileRow(wave.firstPixel), last = tileRow(wave.firstPixel + wave.pixels - 1);
    return {first * tilesX_, (last + 1 - first) * tilesX_};
}

void TilePaths::traceUnseen(WavefrontPathTracer& tracer, const CacheTap& tap, const gpu::CacheRule& rule,
                            uint32_t first) const {
    for (Waves waves = tracer.unseenCameraWaves(unseen_, tap.mostUnseen()); const auto wave = waves.next();) {
        const PathTap listening = tap.listenUnseen(tracer, rule, first, *wave);
        tracer.traceWave(*wave, &listening);
        first += wave->paths();
    }
}

} // namespace irradia
