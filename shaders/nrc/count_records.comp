#version 460
#extension GL_GOOGLE_include_directive : require
// A place among the records for each training path's, by a prefix sum, and what the frame's targets tell of the scene's
// brightness. One workgroup, sums in a fixed order.
#include "lib/kernel.glsl"
#include "shared/cache.h"

COUNTERS(0, counters);
RECORDS_READ(1, pathSums);
WORDS_WRITE(2, firstRecords);
layout(set = 0, binding = 3, std430) buffer State { CacheState cacheState; };
layout(push_constant) uniform Push { RecordsParams params; };

shared uint counts[gl_WorkGroupSize.x];
shared float sums[gl_WorkGroupSize.x], largest[gl_WorkGroupSize.x];

// The scale is a power of two that brings the mean target near 1, and stays while it is within a factor of 4: each change
// changes what all predictions mean.
void updateScale(uint records, float sum, float most) {
    cacheState.largestTarget = most;
    if (records == 0u) return;
    float mean = sum / float(records);
    cacheState.frameTarget = mean;
    cacheState.meanTarget = cacheState.frames == 0u ? mean : mix(mean, cacheState.meanTarget, params.meanDecay);
    ++cacheState.frames;
    float scaled = cacheState.meanTarget * cacheState.scale;
    bool isUsable = cacheState.meanTarget > 1e-20 && cacheState.meanTarget < 1e15;
    if (isUsable && (scaled < 0.25 || scaled > 4.0)) {
        int exponent = -int(round(log2(cacheState.meanTarget)));
        cacheState.scale = uintBitsToFloat(uint(127 + exponent) << 23u);
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint share = (params.paths + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * share, params.paths), end = min(begin + share, params.paths);
    uint count = 0u;
    float sum = 0.0, most = 0.0;
    for (uint path = begin; path < end; ++path) {
        uvec4 s = loadRecord(pathSums, path);
        count += s.x;
        sum += uintBitsToFloat(s.y);
        most = max(most, uintBitsToFloat(s.z));
    }
    counts[lane] = count;
    sums[lane] = sum;
    largest[lane] = most;
    barrier();
    if (lane == 0u) {
        uint total = 0u;
        sum = 0.0;
        most = 0.0;
        for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) {
            uint here = counts[i];
            counts[i] = total;
            total += here;
            sum += sums[i];
            most = max(most, largest[i]);
        }
        counters[kRecordCounter] = min(total, params.capacity);
        counters[kSkippedRecords] = total - min(total, params.capacity);
        updateScale(total, sum, most);
    }
    barrier();
    uint first = counts[lane];
    for (uint path = begin; path < end; ++path) {
        storeWord(firstRecords, path, first);
        first += loadRecord(pathSums, path).x;
    }
}
