// What a radiance cache adds to path tracing, in double precision: from Müller et al. 2021, "Real-time Neural
// Radiance Caching for Path Tracing" (sections 3.4 and 4), and the contract at the head of
// shaders/shared/cache.h.
#pragma once

#include "tests/reference/encodings.h"
#include "tests/reference/math.h"
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace irradia::reference {

// ---- vertices ----

Vec2 sphericalCoordinates(const Vec3& d); // polar angle / pi, azimuth / (2 pi) + 1/2

struct CacheBox {
    Vec3 low, high;
    double scale = 1.0;

    bool contains(const Vec3& p) const;
};

struct CacheVertex {
    Vec3 position, view, geometricNormal, shadingNormal; // view: back along the path's ray
    double distance = 1.0;                               // that the ray has come
    double pdf = 1.0;                                    // with which it was chosen; not used of the camera's
    double roughness = 1.0;
    Vec3 diffuse{0.0}, specular{0.0};
    bool isDelta = false;

    Vec3 throughput{0.0}; // of the path's next ray
    Vec3 light{0.0};      // of the light sample, where it arrives
    Vec3 emission{0.0};   // that the next ray meets
    bool goesOn = false;  // there is a next ray
};

Values cacheInputs(const CacheVertex& vertex, const CacheBox& box);

double primaryArea(const CacheVertex& primary);                                  // a0
double areaSpread(const std::vector<CacheVertex>& path, size_t from, size_t to); // a(x_from ... x_to)

// ---- paths ----

constexpr size_t kMaxRecorded = 8; // vertices of a training path

struct CacheSettings {
    CacheBox box;
    double spread = 0.01, trainingSpread = 0.01;
    uint32_t endDepth = 0xffffffffu; // paths ask at this vertex at the latest
    uint32_t deepest = 0xffffffffu;  // and render no further than to this one
    uint32_t lastDepth = 0xffffffffu;
    double residualShare = 0.0;
};

struct CacheQuery {
    Values inputs;
    Vec3 weight;
};

struct TrainingVertex {
    Values inputs;
    Vec3 gathered, throughput;
};

struct TrainingPath {
    std::vector<TrainingVertex> vertices;
    std::optional<Values> end; // inputs where it ends in the cache
};

struct CacheWalk {
    std::optional<CacheQuery> query;
    TrainingPath training;
    bool isUncertain = false; // a spread is so near its threshold that rounding decides
};

// `isUnbiased`: the suffix is not ended by its spread; `goesPastQuery`: whether a path that asks at the
// vertex is chosen for the residual.
CacheWalk walk(const std::vector<CacheVertex>& path, const CacheSettings& settings, bool isUnbiased,
               const std::function<bool(size_t)>& goesPastQuery);

// ---- predictions and targets ----

Vec3 reflectance(const Values& inputs); // alpha + beta

struct Prediction {
    Vec3 radiance{0.0};
    bool isClamped = false; // it was no number, or beyond all radiance
};

constexpr double kLargestRadiance = 1e15;

Prediction toRadiance(const Vec3& prediction, const Vec3& factor, double scale);
Vec3 toTarget(const Vec3& radiance, const Vec3& factor, double scale); // 0 where the factor is below 1e-3

// L_s at the vertices; `last` is that of the end in the cache.
std::vector<Vec3> targets(const TrainingPath& path, const Vec3& last);

// Of records that are more than there is room for, `kept` of n: whether record k is kept, and at which place.
std::optional<uint64_t> evenPlace(uint64_t k, uint64_t kept, uint64_t n);

struct Brightness {
    double scale = 1.0, rescaling = 1.0, brightness = 0.0, frameBrightness = 0.0, largest = 0.0;
    uint32_t frames = 0;

    void addFrame(uint32_t records, double rootSum, double most, double decay);
};

} // namespace irradia::reference
