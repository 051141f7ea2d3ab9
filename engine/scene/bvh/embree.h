// Embree 3 or 4, whichever the build found. They differ in the header's name and in what a ray is traced
// with.
#pragma once

#if IRRADIA_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace irradia {

#if IRRADIA_EMBREE_MAJOR == 3

inline void embreeIntersect(RTCScene scene, RTCRayHit& hit) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &hit);
}

inline void embreeOccluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}

#else

inline void embreeIntersect(RTCScene scene, RTCRayHit& hit) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    rtcIntersect1(scene, &hit, &arguments);
}

inline void embreeOccluded(RTCScene scene, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    rtcOccluded1(scene, &ray, &arguments);
}

#endif

} // namespace irradia
