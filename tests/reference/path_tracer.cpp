#include "tests/reference/path_tracer.h"
#include "tests/reference/parallel.h"

namespace irradia::reference {

namespace {

constexpr double kPortalShare = 0.25; // more would let the weights of paths by the BSDF alone grow

// Weight of light found by BSDF sampling. pdfBsdf = 0 only for camera rays, which have no other way to find
// it.
double weightOfBsdfSample(LightStrategy strategy, bool isCameraRay, double pdfBsdf, double pdfLight) {
    if (isCameraRay || strategy == LightStrategy::BsdfOnly) return 1.0;
    return strategy == LightStrategy::LightOnly ? 0.0 : pdfBsdf / (pdfBsdf + pdfLight);
}

double weightOfLightSample(LightStrategy strategy, double pdfLight, double pdfBsdf) {
    return strategy == LightStrategy::LightOnly ? 1.0 : pdfLight / (pdfLight + pdfBsdf);
}

} // namespace

PathTracer::PathTracer(const Scene& scene)
    : scene_(&scene)
    , bvh_(triangleShapes(scene))
    , lights_(scene) {}

Vec3 PathTracer::leave(const SurfacePoint& point) const {
    return point.position + point.offset * point.geometricNormal;
}

Vec3 PathTracer::incident(const Ray& ray, const Walk& walk, const Estimator& estimator) const {
    const auto weight = [&](double pdfLight) {
        return weightOfBsdfSample(estimator.settings.strategy, walk.edge == 0, walk.pdf, pdfLight);
    };
    const auto hit = bvh_.closest(ray);
    if (!hit) return weight(lights_.environmentPdf(ray.direction)) * lights_.environment(ray.direction);

    const TriangleShape& shape = bvh_.shape(hit->triangle);
    const bool front = glm::dot(glm::cross(shape.e1, shape.e2), ray.direction) < 0.0;
    Vec3 sum = emittedRadiance(*scene_, hit->triangle, {hit->u, hit->v}, front);
    if (sum != Vec3(0.0)) sum *= weight(lights_.trianglePdf(hit->triangle, ray.direction, hit->distance));
    if (walk.edge > estimator.settings.maxBounces) return sum;

    const SurfacePoint point = surfaceAt(*scene_, shape, ray, *hit);
    if (estimator.settings.strategy != LightStrategy::BsdfOnly) sum += direct(point, estimator);
    return sum + indirect(point, walk, estimator);
}

Vec3 PathTracer::direct(const SurfacePoint& point, const Estimator& estimator) const {
    const Vec3 origin = leave(point);
    const LightSample light = lights_.sample(origin, estimator.random);
    if (light.pdf == 0.0 || light.radiance == Vec3(0.0)) return Vec3(0.0);
    if (glm::dot(point.geometricNormal, light.direction) <= 0.0) return Vec3(0.0);
    if (bvh_.isOccluded({origin, light.direction}, light.distance * (1.0 - 1e-9))) return Vec3(0.0);
    const Vec3 scattered = point.scattered(light.direction);
    if (scattered == Vec3(0.0)) return scattered;
    const double weight = weightOfLightSample(estimator.settings.strategy, light.pdf,
                                              scatterPdf(point, light.direction, estimator));
    return weight / light.pdf * scattered * light.radiance;
}

double PathTracer::scatterPdf(const SurfacePoint& point, const Vec3& direction,
                              const Estimator& estimator) const {
    const auto& portal = estimator.settings.portal;
    const double pdf = point.pdf(direction);
    if (!portal || !portal->faces(leave(point))) return pdf;
    return glm::mix(pdf, portal->pdf(leave(point), direction), kPortalShare);
}

BsdfSample PathTracer::scatter(const SurfacePoint& point, const Estimator& estimator) const {
    const auto& portal = estimator.settings.portal;
    Random& random = estimator.random;
    const bool isMixed = portal && portal->faces(leave(point));
    BsdfSample sample;
    if (isMixed && random.uniform() < kPortalShare) {
        sample.direction = portal->sample(leave(point), random.uniform2());
    } else {
        const double uLobe = random.uniform();
        sample = point.bsdf.sample(point.view, uLobe, random.uniform2());
        sample.direction = point.shading.toWorld(sample.direction);
    }
    if (!isMixed) return sample;
    sample.pdf = scatterPdf(point, sample.direction, estimator);
    sample.weight = sample.pdf > 0.0 ? point.scattered(sample.direction) / sample.pdf : Vec3(0.0);
    return sample;
}

Vec3 PathTracer::indirect(const SurfacePoint& point, const Walk& walk, const Estimator& estimator) const {
    const BsdfSample sample = scatter(point, estimator);
    const double importance = walk.importance * maxComponent(sample.weight);
    if (importance == 0.0 || glm::dot(point.geometricNormal, sample.direction) <= 0.0) return Vec3(0.0);

    const bool isSafe = walk.edge < estimator.settings.rouletteBounce;
    const double survival = isSafe ? 1.0 : std::clamp(importance, 0.05, 1.0);
    if (survival < 1.0 && estimator.random.uniform() >= survival) return Vec3(0.0);
    const Walk next{walk.edge + 1, sample.pdf, importance / survival};
    return sample.weight / survival * incident({leave(point), sample.direction}, next, estimator);
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
