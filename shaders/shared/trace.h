// Parameters of the tracing kernels intersect_closest and intersect_shadow.
//   intersect_closest: 0 bvh (quads), 1 rays (RayQueue), 2 counters, 3 hits (quads)
//   intersect_shadow:  0 bvh (quads), 1 shadow rays (ShadowRayQueue), 2 counters, 3 visibility (words)
// and what path/transparency adds where surfaces let light through.
#ifndef IRRADIA_SHARED_TRACE_H
#define IRRADIA_SHARED_TRACE_H
#include "shared/path.h"
#include "shared/types.h"
SHARED_BEGIN

// A subgroup owns kRaysPerLane x subgroup size consecutive rays of the queue and refills its lanes from them: a
// dispatch needs count / (kRaysPerLane * workgroup size) groups, rounded up.
SHARED_CONST uint kRaysPerLane = 32u;

struct TraceParams {
    uint counter; // which of the QueueCounters holds the number of rays
    uint root;    // item of the root (see shared/bvh.h)
    WaveParams wave; // whose rays they are; read only where surfaces let light through
};

SHARED_END
#endif
