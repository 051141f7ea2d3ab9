// A path of a renderer with a cache (shared/cache.h): where it asks, where it ends, and what it records for training.
// Bindings: those of tap_light.glsl, then `queries`, `queryWeights`, `trainingQueries` (quads) and `cacheCounters`;
// `params` is a WaveParams, `frame` FrameConstants, `rule` a CacheRule.
#ifndef IRRADIA_PATH_CACHED_PATH_GLSL
#define IRRADIA_PATH_CACHED_PATH_GLSL
#include "lib/math.glsl"
#include "lib/rng.glsl"
#include "path/surface.glsl"
#include "path/taps/radiance_cache/tap_light.glsl"
#include "path/wave.glsl"
#include "shared/network.h"

struct CachedPath {
    uint path;
    uint training; // + 1, 0 = none
    uint flags;
    float a0;
    float spread; // square root of the area spread
    bool renders; // what follows is seen
    bool trains;  // what follows is learned from
    bool counts;  // the vertex, for the view
    vec3 weight;  // of the training path, from its last recorded vertex on
    uint vertices;
};

// ---- state ----

// The first row or column of a tile, of `tiles` that share `size` pixels.
uint tileBegin(uint tile, uint tiles, uint size) { return (tile * size + tiles - 1u) / tiles; }

// The training path that a path is, + 1, counted from rule.firstTraining on: of each tile's pixels one has one, another in each
// frame, in the first of the frame's samples. Of waves that are not seen all paths train.
uint trainingPathOf(uint path, uint pixel) {
    if (rule.tilesX == 0u) return 0u;
    if (pixel >= kFirstTrainingPixel) return rule.waveTraining - rule.firstTraining + path + 1u;
    uvec2 at = uvec2(pixel % frame.width, pixel / frame.width);
    uvec2 tiles = uvec2(rule.tilesX, rule.tilesY);
    uvec2 tile = at * tiles / uvec2(frame.width, frame.height);
    uvec2 low = uvec2(tileBegin(tile.x, tiles.x, frame.width), tileBegin(tile.y, tiles.y, frame.height));
    uvec2 high = uvec2(tileBegin(tile.x + 1u, tiles.x, frame.width), tileBegin(tile.y + 1u, tiles.y, frame.height));
    uint index = tile.y * tiles.x + tile.x;
    uvec4 random = randomBits(index, params.sampleIndex, kTileBlock, frame.seed);
    bool chosen = all(equal(at, low + uvec2(uniformIndex(random.x, high.x - low.x), uniformIndex(random.y, high.y - low.y))));
    return chosen && sampleInWave(path) == 0u ? index - rule.firstTraining + 1u : 0u;
}

// distance and cosine: of the ray at the vertex where it arrives.
CachedPath beginPath(uint path, uint pixel, float distance, float cosine) {
    CachedPath c;
    c.path = path;
    c.training = trainingPathOf(path, pixel);
    float choice = unitFloat(randomBits(pixel, sampleOf(path), kCameraBlock, frame.seed).z);
    c.flags = (choice < rule.unbiasedShare ? kPathUnbiased : 0u) | (pixel >= kFirstTrainingPixel ? kPathEnded : 0u);
    c.a0 = distance * distance / (4.0 * kPi * cosine);
    c.spread = 0.0;
    c.weight = vec3(1.0);
    c.vertices = 0u;
    return c;
}

CachedPath continuePath(uint path, float distance, float cosine, float pdf, vec3 passage) {
    uvec4 state = pathStates[path];
    CachedPath c;
    c.path = path;
    c.training = state.z;
    c.flags = state.w;
    c.a0 = uintBitsToFloat(state.x);
    bool isMirrored = (c.flags & kPathMirrored) != 0u; // a delta lobe adds no spread
    c.spread = uintBitsToFloat(state.y) + (isMirrored ? 0.0 : distance * inversesqrt(pdf * cosine));
    uvec4 training = trainingPaths[max(c.training, 1u) * kTrainingPathVectors - kTrainingPathVectors];
    c.weight = uintBitsToFloat(training.rgb) * passage;
    c.vertices = training.w;
    return c;
}

void storePath(CachedPath c) {
    pathStates[c.path] = uvec4(floatBitsToUint(c.a0), floatBitsToUint(c.spread), c.trains ? c.training : 0u, c.flags);
}

// ---- vertices ----

vec2 sphericalCoordinates(vec3 d) {
    return vec2(acos(clamp(d.z, -1.0, 1.0)) * kInvPi, atan(d.y, d.x) * (0.5 * kInvPi) + 0.5);
}

CacheInputs inputsOf(Surface s, vec3 view) {
    vec3 position = (s.position - rule.boxLow.xyz) * rule.boxLow.w;
    vec3 beta = s.bsdf.specularF0;
    if (s.isGlass) beta += s.glass.tint;
    return packCacheInputs(position, sphericalCoordinates(view), sphericalCoordinates(s.shadingNormal), 1.0 - exp(-s.roughness),
                           s.bsdf.diffuse, beta);
}

bool isInBox(vec3 p) { return all(greaterThanEqual(p, rule.boxLow.xyz)) && all(lessThanEqual(p, rule.boxHigh.xyz)); }

// Müller 2021, section 3.4: the path's footprint has grown beyond a share c of that of the primary vertex.
bool hasSpread(CachedPath c, float threshold) { return c.spread * c.spread > threshold * c.a0; }

void ask(bool asks, CachedPath c, CacheInputs inputs, vec3 weight) {
    uvec4 ballot = subgroupBallot(asks);
    uint base = 0u;
    if (subgroupElect()) base = atomicAdd(cacheCounters[kQueryCounter], subgroupBallotBitCount(ballot));
    uint row = subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(ballot);
    if (!asks) return;
    [[unroll]] for (uint q = 0u; q < kCacheInputQuads; ++q)
        storeQuad(queries, quadIndex(row, q, kCacheInputQuads), floatBitsToUint(inputs.quads[q]));
    storeQuad(queryWeights, row, uvec4(floatBitsToUint(weight), c.path));
}

uint vertexAt(CachedPath c, uint vertex) {
    return ((c.training - 1u) * kMaxTrainingVertices + vertex) * kTrainingVertexVectors;
}

// The last recorded vertex, if any, gets its throughput to here.
void closeVertex(CachedPath c) {
    if (c.vertices > 0u) trainingVertices[vertexAt(c, c.vertices - 1u) + kThroughput] = uvec4(floatBitsToUint(c.weight), 0u);
}

// A delta lobe scatters nothing that a cache could hold.
bool isDelta(Surface s) { return s.bsdf.alpha <= kMinAlpha && maxComponent(s.bsdf.diffuse) == 0.0; }

void recordVertex(inout CachedPath c, CacheInputs inputs) {
    closeVertex(c);
    uint at = vertexAt(c, c.vertices);
    [[unroll]] for (uint q = 0u; q < kCacheInputQuads; ++q) trainingVertices[at + q] = floatBitsToUint(inputs.quads[q]);
    trainingVertices[at + kGathered] = uvec4(0u);
    trainingVertices[at + kThroughput] = uvec4(0u);
    c.weight = vec3(1.0);
    ++c.vertices;
}

// The training path ends in the cache: its last radiance is what the cache predicts here.
void endInCache(CachedPath c, CacheInputs inputs) {
    closeVertex(c);
    [[unroll]] for (uint q = 0u; q < kCacheInputQuads; ++q)
        storeQuad(trainingQueries, quadIndex(rule.firstTraining + c.training - 1u, q, kCacheInputQuads), floatBitsToUint(inputs.quads[q]));
    uint at = (c.training - 1u) * kTrainingPathVectors;
    trainingPaths[at].w = c.vertices;
    trainingPaths[at + 1u] = uvec4(0u, 0u, 0u, 1u);
}

// A path arrives at a vertex. `beta` is its weight for the picture, and becomes that of what follows: 0 where it ends.
CachedPath visitVertex(bool alive, uint path, uint pixel, Surface s, vec3 view, float distance, float pdf, vec3 passage,
                       inout vec3 beta) {
    float cosine = max(abs(dot(s.geometricNormal, view)), 1e-6);
    CachedPath c;
    if (params.depth == 0u)
        c = beginPath(path, pixel, distance, cosine);
    else
        c = continuePath(path, distance, cosine, pdf, passage);
    c.trains = alive && c.training != 0u;
    c.renders = alive && (c.flags & kPathEnded) == 0u && params.depth < rule.deepest;
    bool beforeQuery = c.renders && (c.flags & kPathAsked) == 0u;
    c.counts = (kView == kViewPathLength && c.renders) || (kView == kViewEndVertex && beforeQuery && params.depth > 0u);
    CacheInputs inputs = inputsOf(s, view);
    bool delta = isDelta(s);
    bool isCached = isInBox(s.position) && !delta;

    bool asks = beforeQuery && isCached && (hasSpread(c, rule.boxHigh.w) || params.depth >= rule.endDepth);
    float choice = unitFloat(randomBits(pixel, sampleOf(path), lightChoiceBlock(params.depth), frame.seed).y);
    bool goesOn = choice < rule.residualShare;
    float share = max(rule.residualShare, 1e-6);
    ask(asks, c, inputs, goesOn ? beta * (1.0 - 1.0 / share) : beta);
    c.renders = c.renders && (!asks || goesOn);
    beta = c.renders ? (asks ? beta / share : beta) : vec3(0.0);
    c.flags |= asks ? kPathAsked : 0u;
    c.flags |= c.renders ? 0u : kPathEnded;

    if (c.trains) {
        // The vertex that is asked plays the primary vertex to the suffix, as the first of a path from a surface does.
        bool inSuffix = (c.flags & (kPathAsked | kPathEnded)) != 0u && !asks && params.depth > 0u;
        bool suffixEnds = inSuffix && (c.flags & kPathUnbiased) == 0u && hasSpread(c, rule.trainingSpread);
        if (isCached && (suffixEnds || params.depth >= rule.lastDepth)) {
            endInCache(c, inputs);
            c.trains = false;
        } else if (isCached && c.vertices < kMaxTrainingVertices) {
            recordVertex(c, inputs);
            c.counts = c.counts || kView == kViewTrainingDensity;
        }
    }
    c.spread = asks ? 0.0 : c.spread;
    c.flags = delta ? c.flags | kPathMirrored : c.flags & ~kPathMirrored;
    return c;
}

// The path leaves the vertex: with a light sample (which its shadow ray may take away again) and with a ray.
void leaveVertex(CachedPath c, vec3 directLight, vec3 throughput) {
    if (c.trains) {
        uint at = (c.training - 1u) * kTrainingPathVectors;
        trainingPaths[at] = uvec4(floatBitsToUint(c.weight * throughput), c.vertices);
        trainingPaths[at + 1u] = uvec4(floatBitsToUint(c.weight * directLight), 0u);
    }
    if (c.renders || c.trains) storePath(c);
}

#endif
