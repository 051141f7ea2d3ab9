// What a wave of paths binds of a cache: its tap, with the ranges of the training paths that the wave may
// write.
#pragma once

#include "engine/path/cache_paths.h"
#include "nrc/cache/cache.h"
#include "nrc/learning/batch_rows.h"

namespace irradia {

CachePaths boundPaths(const CacheTap& tap, gpu::CacheRule rule, const RowRange& training);

// Of a wave that is not seen, and whose path k is training path `first` + k.
CachePaths unseenPaths(const CacheTap& tap, gpu::CacheRule rule, uint32_t first, uint32_t paths);

} // namespace irradia
