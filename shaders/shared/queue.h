// The queues of the wavefront: work items as quads, their counters and indirect arguments.
#ifndef IRRADIA_SHARED_QUEUE_H
#define IRRADIA_SHARED_QUEUE_H
#include "shared/types.h"
SHARED_BEGIN

// RayQueue item, 3 quads:
//   0: origin xyz, path index (uint)          path index = its number in the wave (path/wave.glsl)
//   1: direction xyz (unit), pdf of the BSDF sample that made it (solid angle; 0 for camera rays)
//   2: throughput beta rgb, shading normal of the vertex it leaves (octahedral; of camera rays 0)
SHARED_CONST uint kRayQuads = 3u;

// Hit, 1 quad per RayQueue slot: t (float), primitive (index of a triangle, kNoPrimitive = escaped),
// barycentrics u, v (floats): the point is p0 + u e1 + v e2.
SHARED_CONST uint kNoPrimitive = 0xffffffffu;

// Passage, 1 quad per path of the wave, only in scenes that let light through: what is left of the light from the end of
// the path's ray on its way (rgb), and the media the ray travels in (path/media.glsl).

// ShadowRayQueue item, 3 quads:
//   0: origin xyz, t max (float)
//   1: direction xyz (unit), path index (uint)
//   2: contribution rgb if unoccluded, unused
// Visibility, 1 uint per ShadowRayQueue slot: 1 = unoccluded, 0 = occluded. In scenes that let light through 1 quad: the
// share (rgb) of it that arrives.
SHARED_CONST uint kShadowRayQuads = 3u;

// QueueCounters: a storage buffer of uints.
SHARED_CONST uint kRayCounter = 0u;       // + 0 or 1: items in the current and the next RayQueue
SHARED_CONST uint kShadowRayCounter = 2u; // items in the ShadowRayQueue
SHARED_CONST uint kTracedRays = 3u;       // rays traced so far this frame, all kinds: low word
SHARED_CONST uint kTracedRaysHigh = 4u;   // and high word
SHARED_CONST uint kCounters = 8u;

SHARED_END
#endif
