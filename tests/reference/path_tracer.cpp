#include "tests/reference/path_tracer.h"
#include "tests/reference/parallel.h"
#include "tests/reference/passing.h"
#include <algorithm>

namespace irradia::reference {

namespace {

constexpr double kPortalShare = 0.25; // more would let the weights of paths by the BSDF alone grow

// Weight of light found by BSDF sampling. pdfBsdf = 0 only for camera rays, which have no other way to find
// it.
double weightOfBsdfSample(LightStrategy strategy, bool isCameraRay, double pdfBsdf, double pdfLight) {
    if (isCameraRay || strategy == LightStrategy::BsdfOnly) return 1.0;
    return strategy == LightStrategy::LightOnly ? 0.0 : pdfBsdf / (pdfBsdf + pdfLight);
}

// Chance that a path goes straight on where both ways are open; at most 0.9 of a point that is all there.
// Any choice is unbiased: this one leaves the weights of what is half there at 1.
double passingChance(const Passing& passing) {
    if (passing.coverage == 0.0) return 1.0;
    return std::min(maxComponent(passing.share), 1.0 - 0.1 * passing.coverage);
}

double weightOfLightSample(LightStrategy strategy, double pdfLight, double pdfBsdf) {
    return strategy == LightStrategy::LightOnly ? 1.0 : pdfLight / (pdfLight + pdfBsdf);
}

} // namespace

PathTracer::PathTracer(const Scene& scene)
    : scene_(&scene)
    , bvh_(triangleShapes(scene))
    , lights_(scene)
    , letsPass_(std::any_of(scene.materials.begin(), scene.materials.end(), letsPass)) {}

Vec3 PathTracer::incident(const Ray& ray, const Walk& walk, const Estimator& estimator) const {
    const auto weight = [&](double pdfLight) {
        return weightOfBsdfSample(estimator.settings.strategy, walk.edge == 0, walk.pdf, pdfLight);
    };
    Vec3 sum(0.0), passed(1.0); // passed: share that what has been met lets through of what comes next
    auto hit = bvh_.closest(ray);
    for (; hit; hit = bvh_.closest(ray, 1e300, hit->distance)) {
        const TriangleShape& shape = bvh_.shape(hit->triangle);
        const uint32_t material = scene_->triangles[hit->triangle].material;
        const bool front = isFront(shape, ray);
        const int medium = mediaAt(*scene_, material, front, walk.media).here.top;
        const Vec3 left = passed * attenuation(*scene_, medium, hit->distance);
        const Vec3 emitted = emittedRadiance(*scene_, hit->triangle, {hit->u, hit->v}, front);
        if (emitted != Vec3(0.0))
            sum += weight(lights_.trianglePdf(hit->triangle, ray.direction, hit->distance)) * left * emitted;

        const Passing passing = passingAt(*scene_, shape, ray, *hit);
        const bool scatters = walk.edge <= estimator.settings.maxBounces && passing.coverage > 0.0;
        const double chance = scatters ? passingChance(passing) : 1.0;
        if (chance == 0.0 || (chance < 1.0 && estimator.random.uniform() >= chance)) {
            const Vec3 share = passing.coverage / (1.0 - chance) * left;
            return sum + share * scattered(ray, *hit, walk, maxComponent(share), estimator);
        }
        passed *= passing.share / chance;
        if (passed == Vec3(0.0)) return sum;
    }
    return sum + weight(lights_.environmentPdf(ray.direction)) * passed * lights_.environment(ray.direction);
}

Vec3 PathTracer::scattered(const Ray& ray, const Hit& hit, const Walk& walk, double share,
                           const Estimator& estimator) const {
    const SurfacePoint point = surfaceAt(*scene_, bvh_.shape(hit.triangle), ray, hit, walk.media);
    Vec3 sum(0.0);
    if (estimator.settings.strategy != LightStrategy::BsdfOnly) sum += direct(point, estimator);
    if (!scene_->lights.empty()) sum += directPunctual(point, estimator);
    Walk here = walk;
    here.importance *= share;
    return sum + indirect(point, here, estimator);
}

Vec3 PathTracer::visibility(const SurfacePoint& point, const Vec3& direction, double distance) const {
    const Ray ray{point.leave(direction), direction};
    const double limit = distance * (1.0 - 1e-9);
    if (!letsPass_ && bvh_.isOccluded(ray, limit)) return Vec3(0.0);
    Vec3 share(1.0);
    if (letsPass_)
        for (auto hit = bvh_.closest(ray, limit); hit; hit = bvh_.closest(ray, limit, hit->distance)) {
            share *= passingAt(*scene_, bvh_.shape(hit->triangle), ray, *hit).share;
            if (share == Vec3(0.0)) return share;
        }
    const bool isInfinite = distance >= 1e300;
    return isInfinite ? share : share * attenuation(*scene_, point.mediaTowards(direction).top, distance);
}

Vec3 PathTracer::direct(const SurfacePoint& point, const Estimator& estimator) const {
    const LightSample light = lights_.sample(point.beforeIt(), estimator.random);
    if (light.pdf == 0.0 || light.radiance == Vec3(0.0)) return Vec3(0.0);
    const Vec3 scattered = point.scattered(light.direction);
    if (scattered == Vec3(0.0)) return scattered;
    const Vec3 visible = visibility(point, light.direction, light.distance);
    if (visible == Vec3(0.0)) return visible;
    const double weight = weightOfLightSample(estimator.settings.strategy, light.pdf,
                                              scatterPdf(point, light.direction, estimator));
    return weight / light.pdf * scattered * visible * light.radiance;
}

Vec3 PathTracer::directPunctual(const SurfacePoint& point, const Estimator& estimator) const {
    const PunctualSample light = samplePunctual(scene_->lights, point.beforeIt(), estimator.random.uniform());
    if (light.chance == 0.0) return Vec3(0.0);
    const Vec3 scattered = point.scatteredPunctual(light.direction);
    if (scattered == Vec3(0.0)) return scattered;
    return visibility(point, light.direction, light.distance) / light.chance * scattered * light.irradiance;
}

double PathTracer::scatterPdf(const SurfacePoint& point, const Vec3& direction,
                              const Estimator& estimator) const {
    const auto& portal = estimator.settings.portal;
    const double pdf = point.pdf(direction);
    if (!portal || !portal->faces(point.beforeIt())) return pdf;
    return glm::mix(pdf, portal->pdf(point.beforeIt(), direction), kPortalShare);
}

BsdfSample PathTracer::scatter(const SurfacePoint& point, const Estimator& estimator) const {
    const auto& portal = estimator.settings.portal;
    Random& random = estimator.random;
    const bool isMixed = portal && portal->faces(point.beforeIt());
    BsdfSample sample;
    if (isMixed && random.uniform() < kPortalShare) {
        sample.direction = portal->sample(point.beforeIt(), random.uniform2());
    } else {
        const double uLobe = random.uniform();
        sample = point.sample(uLobe, random.uniform2());
        if (sample.pdf == 0.0) return sample; // rejected, though another lobe may scatter there
    }
    if (!isMixed) return sample;
    sample.pdf = scatterPdf(point, sample.direction, estimator);
    sample.weight = sample.pdf > 0.0 ? point.scattered(sample.direction) / sample.pdf : Vec3(0.0);
    return sample;
}

Vec3 PathTracer::indirect(const SurfacePoint& point, const Walk& walk, const Estimator& estimator) const {
    const BsdfSample sample = scatter(point, estimator);
    const double importance = walk.importance * maxComponent(sample.weight);
    if (importance == 0.0 || !point.isValid(sample.direction)) return Vec3(0.0);

    const bool isSafe = walk.edge < estimator.settings.rouletteBounce;
    const double survival = isSafe ? 1.0 : std::clamp(importance, 0.05, 1.0);
    if (survival < 1.0 && estimator.random.uniform() >= survival) return Vec3(0.0);
    const Walk next{walk.edge + 1, sample.pdf, importance / survival, point.mediaTowards(sample.direction)};
    const Ray ray{point.leave(sample.direction), sample.direction};
    return sample.weight / survival * incident(ray, next, estimator);
}

ImageEstimate PathTracer::render(const Camera& camera, const RenderSettings& settings) const {
    const CameraRays rays(camera, settings.width, settings.height);
    ImageEstimate image{settings.width, settings.height, {}, {}};
    image.mean.resize(static_cast<size_t>(settings.width) * settings.height);
    image.variance.resize(image.mean.size());
    parallelFor(settings.height, settings.threads, [&](int y) {
        for (int x = 0; x < settings.width; ++x) {
            const size_t pixel = static_cast<size_t>(y) * settings.width + x;
            Random random(settings.seed, pixel);
            Vec3 mean(0.0), squares(0.0); // Welford 1962
            for (int i = 1; i <= settings.samples; ++i) {
                const Ray ray = rays.through(x, y, random.uniform2());
                const Vec3 value = incident(ray, Walk{}, Estimator{settings, random});
                const Vec3 fromOldMean = value - mean;
                mean += fromOldMean / static_cast<double>(i);
                squares += fromOldMean * (value - mean);
            }
            image.mean[pixel] = mean;
            image.variance[pixel] =
                squares / (settings.samples - 1.0) / static_cast<double>(settings.samples);
        }
    });
    return image;
}

} // namespace irradia::reference
