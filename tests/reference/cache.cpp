#include "tests/reference/cache.h"

namespace irradia::reference {
namespace {

Vec3 throughputBetween(const std::vector<CacheVertex>& path, size_t from, size_t to) {
    Vec3 product(1.0);
    for (size_t v = from; v < to; ++v) product *= path[v].throughput;
    return product;
}

// Light that the vertex sends along the path towards the eye without the help of those after it.
Vec3 ownLight(const CacheVertex& v) {
    return v.light + (v.goesOn ? v.throughput * v.emission : Vec3(0.0));
}

double cosineOf(const CacheVertex& v) {
    return std::max(std::abs(glm::dot(v.geometricNormal, v.view)), 1e-6);
}

class Walker {
public:
    Walker(const std::vector<CacheVertex>& path, const CacheSettings& settings)
        : path_(path)
        , settings_(settings) {
        while (reached_ < path.size() && path[reached_++].goesOn) {
        }
    }

    CacheWalk walk(bool isUnbiased, const std::function<bool(size_t)>& goesPastQuery) {
        const size_t query = findQuery();
        if (query < reached_) {
            const double share = goesPastQuery(query) ? 1.0 - 1.0 / settings_.residualShare : 1.0;
            result_.query = {cacheInputs(path_[query], settings_.box),
                             throughputBetween(path_, 0, query) * share};
        }
        record(findEnd(query, isUnbiased));
        return result_;
    }

private:
    // A delta lobe scatters nothing that a cache could hold.
    bool isCached(size_t v) const { return settings_.box.contains(path_[v].position) && !path_[v].isDelta; }

    bool hasSpread(size_t from, size_t to, double threshold) {
        const double limit = threshold * primaryArea(path_.front()), a = areaSpread(path_, from, to);
        if (std::abs(a - limit) < 1e-4 * limit) result_.isUncertain = true;
        return a > limit;
    }

    size_t findQuery() {
        for (size_t v = 0; v < std::min<size_t>(reached_, settings_.deepest); ++v)
            if (isCached(v) && (v >= settings_.endDepth || hasSpread(0, v, settings_.spread))) return v;
        return reached_;
    }

    // Where the path ends in the cache. The vertex that has asked is the primary vertex of what follows.
    size_t findEnd(size_t query, bool isUnbiased) {
        const bool hasAsked = query < reached_;
        const size_t suffix = hasAsked ? query + 1 : settings_.deepest;
        for (size_t v = 0; v < reached_; ++v) {
            if (!isCached(v)) continue;
            if (v >= settings_.lastDepth) return v;
            if (v >= suffix && !isUnbiased && hasSpread(hasAsked ? query : 0, v, settings_.trainingSpread))
                return v;
        }
        return reached_;
    }

    void record(size_t end) {
        std::vector<size_t> recorded;
        for (size_t v = 0; v < end && recorded.size() < kMaxRecorded; ++v)
            if (isCached(v)) recorded.push_back(v);
        const bool endsInCache = end < reached_;
        for (size_t i = 0; i < recorded.size(); ++i) {
            const size_t at = recorded[i], next = i + 1 < recorded.size() ? recorded[i + 1] : end;
            TrainingVertex vertex{cacheInputs(path_[at], settings_.box), Vec3(0.0), Vec3(0.0)};
            for (size_t v = at; v < next; ++v)
                vertex.gathered += throughputBetween(path_, at, v) * ownLight(path_[v]);
            if (next < end || endsInCache) vertex.throughput = throughputBetween(path_, at, next);
            result_.training.vertices.push_back(vertex);
        }
        if (endsInCache) result_.training.end = cacheInputs(path_[end], settings_.box);
    }

    const std::vector<CacheVertex>& path_;
    const CacheSettings& settings_;
    size_t reached_ = 0;
    CacheWalk result_;
};

bool isRadiance(const Vec3& l) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(l[c]) < kLargestRadiance)) return false;
    return true;
}

} // namespace

Vec2 sphericalCoordinates(const Vec3& d) {
    const double azimuth = std::atan2(d.y, d.x);
    return {std::acos(std::clamp(d.z, -1.0, 1.0)) / kPi, azimuth / (2.0 * kPi) + 0.5};
}

bool CacheBox::contains(const Vec3& p) const {
    return glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThanEqual(p, high));
}

Values cacheInputs(const CacheVertex& v, const CacheBox& box) {
    const Vec3 p = (v.position - box.low) * box.scale;
    const Vec2 direction = sphericalCoordinates(v.view), normal = sphericalCoordinates(v.shadingNormal);
    return {p.x,          p.y,         p.z,         direction.x,
            direction.y,  normal.x,    normal.y,    1.0 - std::exp(-v.roughness),
            v.diffuse.r,  v.diffuse.g, v.diffuse.b, v.specular.r,
            v.specular.g, v.specular.b};
}

double primaryArea(const CacheVertex& primary) {
    return primary.distance * primary.distance / (4.0 * kPi * cosineOf(primary));
}

double areaSpread(const std::vector<CacheVertex>& path, size_t from, size_t to) {
    double sum = 0.0;
    for (size_t v = from + 1; v <= to; ++v)
        if (!path[v - 1].isDelta)
            sum += std::sqrt(path[v].distance * path[v].distance / (path[v].pdf * cosineOf(path[v])));
    return sum * sum;
}

CacheWalk walk(const std::vector<CacheVertex>& path, const CacheSettings& settings, bool isUnbiased,
               const std::function<bool(size_t)>& goesPastQuery) {
    return Walker(path, settings).walk(isUnbiased, goesPastQuery);
}

Vec3 reflectance(const Values& inputs) {
    return {inputs[8] + inputs[11], inputs[9] + inputs[12], inputs[10] + inputs[13]};
}

Prediction toRadiance(const Vec3& prediction, const Vec3& factor, double scale) {
    const Vec3 l = prediction * factor / scale;
    if (!isRadiance(l)) return {Vec3(0.0), true};
    return {glm::max(l, Vec3(0.0)), false};
}

Vec3 toTarget(const Vec3& radiance, const Vec3& factor, double scale) {
    Vec3 target(0.0);
    for (int c = 0; c < 3; ++c)
        if (factor[c] >= 1e-3) target[c] = radiance[c] / factor[c] * scale;
    return target;
}

std::optional<uint64_t> evenPlace(uint64_t k, uint64_t kept, uint64_t n) {
    const uint64_t place = k * kept / n;
    if ((k + 1) * kept / n == place) return std::nullopt;
    return place;
}

std::vector<Vec3> targets(const TrainingPath& path, const Vec3& last) {
    std::vector<Vec3> result(path.vertices.size());
    Vec3 next = last;
    for (size_t v = path.vertices.size(); v-- > 0;)
        result[v] = next = path.vertices[v].gathered + path.vertices[v].throughput * next;
    return result;
}

void Brightness::addFrame(uint32_t records, double rootSum, double most, double decay) {
    largest = most;
    rescaling = 1.0;
    if (records == 0) return;
    frameBrightness = std::pow(rootSum / records, 2.0);
    const double kept = std::min(decay, frames / (frames + 1.0));
    brightness = kept * brightness + (1.0 - kept) * frameBrightness;
    const bool isFar = brightness * scale < 0.25 || brightness * scale > 4.0;
    if (isFar && brightness > 1e-20) {
        const double before = scale;
        scale = std::exp2(-std::round(std::log2(brightness)));
        if (frames > 0) rescaling = scale / before;
    }
    ++frames;
}

} // namespace irradia::reference
