#include "nrc/renderer/cache_tap.h"

namespace irradia {

CacheTap::CacheTap(Device& device)
    : rule_(device, "cache rule", sizeof(gpu::CacheRule)) {}

PathTap CacheTap::listen(WavefrontPathTracer& tracer, const CachePaths& paths) const {
    tracer.graph().update(rule_, paths.rule);
    PathTap tap;
    tap.light = {{tracer.pathStates(), true, true},
                 {paths.trainingPaths, true, true},
                 {paths.trainingVertices, true, true}};
    tap.vertex = {{paths.queries, false, true},         {paths.queryWeights, false, true},
                  {paths.trainingQueries, false, true}, {paths.counters, true, true},
                  {tracer.radiance(), true, true},      {rule_, true, false}};
    if (paths.rule.tilesX > 0) tap.lastDepth = paths.rule.lastDepth;
    return tap;
}

} // namespace irradia
