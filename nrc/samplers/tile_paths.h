// Training paths through the camera (Müller 2021, section 3.4): one in each tile of the picture goes on past
// its query. Where training wants more of them than there are pixels, the others are not seen.
#pragma once

#include "nrc/samplers/cache_tap.h"

namespace irradia {

class TilePaths {
public:
    // Of a picture; at most `most` paths a frame, those that are not seen with them.
    TilePaths(uint32_t width, uint32_t height, uint32_t most);

    uint32_t mostTiles() const { return mostTiles_; }
    uint32_t mostUnseen() const { return most_ - mostTiles_; }
    // Pixels of a wave at most, so that one binding holds the vertices of all tiles that it touches.
    uint32_t mostPixelsOfWave(uint64_t bindingBytes) const;

    // For the frames that follow: about `paths` paths, at least one; tiles as square as the picture allows.
    void choose(double paths);

    uint32_t tiles() const { return tilesX_ * tilesY_; } // training paths 0 to tiles() - 1
    uint32_t unseen() const { return unseen_; }
    void setTiles(gpu::CacheRule& rule) const;
    // The tiles that a wave's pixels touch, whole rows of them.
    RowRange touchedBy(const Wave& wave) const;

    // Traces the paths that are not seen: training paths from number `first` on. All of such a path is
    // suffix.
    void traceUnseen(WavefrontPathTracer& tracer, const CacheTap& tap, const gpu::CacheRule& rule,
                     uint32_t first) const;

private:
    uint32_t width_, height_, most_, mostTiles_;
    uint32_t tilesX_ = 1, tilesY_ = 1, unseen_ = 0;
};

} // namespace irradia
