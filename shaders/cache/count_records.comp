#version 460
#extension GL_GOOGLE_include_directive : require
// A place among the records for each training path's, by a prefix sum, and what the frame's targets tell of the scene's
// brightness. One workgroup, sums in a fixed order.
#include "lib/kernel.glsl"
#include "lib/math.glsl"
#include "shared/cache.h"

COUNTERS(0, counters);
QUADS_READ(1, pathSums);
WORDS_WRITE(2, firstRecords);
layout(set = 0, binding = 3, std430) buffer State { CacheState cacheState; };
layout(push_constant) uniform Push { RecordsParams params; };

shared uint counts[gl_WorkGroupSize.x];
shared float sums[gl_WorkGroupSize.x], largest[gl_WorkGroupSize.x];
shared uint gathers[gl_WorkGroupSize.x];

// The scale is a power of two that brings the targets' brightness near 1, and stays while it is within a factor of 4. Roots,
// since of plain luminance a few huge targets would decide the mean. Until a network has learned there is nothing that
// could keep its meaning.
void updateScale(uint records, float rootSum, float most) {
    cacheState.largestTarget = most;
    cacheState.rescaling = 1.0;
    if (records == 0u) return;
    cacheState.frameBrightness = square(rootSum / float(records));
    float age = float(cacheState.frames);
    cacheState.brightness = mix(cacheState.frameBrightness, cacheState.brightness, min(params.meanDecay, age / (age + 1.0)));
    ++cacheState.frames;
    float scaled = cacheState.brightness * cacheState.scale;
    bool isUsable = cacheState.brightness > 1e-20 && cacheState.brightness < 1e15;
    if (isUsable && (scaled < 0.25 || scaled > 4.0)) {
        int exponent = -int(round(log2(cacheState.brightness)));
        float scale = uintBitsToFloat(uint(127 + exponent) << 23u);
        if (cacheState.frames > 1u) cacheState.rescaling = scale / cacheState.scale;
        cacheState.scale = scale;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint share = (params.paths + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * share, params.paths), end = min(begin + share, params.paths);
    uint count = 0u, light = 0u;
    float sum = 0.0, most = 0.0;
    for (uint path = begin; path < end; ++path) {
        uvec4 s = loadQuad(pathSums, path);
        count += s.x;
        sum += uintBitsToFloat(s.y);
        most = max(most, uintBitsToFloat(s.z));
        light |= s.w;
    }
    counts[lane] = count;
    sums[lane] = sum;
    largest[lane] = most;
    gathers[lane] = light;
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
            cacheState.metLight |= gathers[i];
        }
        counters[kRecordCounter] = min(total, params.capacity);
        counters[kSkippedRecords] = total - min(total, params.capacity);
        updateScale(total, sum, most);
    }
    barrier();
    uint first = counts[lane];
    for (uint path = begin; path < end; ++path) {
        storeWord(firstRecords, path, first);
        first += loadQuad(pathSums, path).x;
    }
}
