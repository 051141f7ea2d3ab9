// The reference: a path tracer in double precision, recursive as the rendering equation reads (Kajiya 1986),
// with next-event estimation and multiple importance sampling (Veach 1997, balance heuristic). Light that
// passes straight on (passing.h) bends no ray: a path's edge goes from one vertex that scatters to the next.
#pragma once

#include "tests/reference/camera_rays.h"
#include "tests/reference/image_estimate.h"
#include "tests/reference/lights.h"
#include "tests/reference/portal.h"
#include "tests/reference/punctual_lights.h"
#include <optional>

namespace irradia::reference {

// How light that has an extent is estimated; all three have the same expectation. Punctual lights are always
// sampled.
enum class LightStrategy { Mis, BsdfOnly, LightOnly };

struct RenderSettings {
    int width = 64;
    int height = 64;
    int samples = 64; // paths a pixel, at least 2 (the variance is estimated from them)
    int maxBounces =
        16; // B: a path has at most B + 2 edges, light connection included; 0 = emission and direct light
    uint64_t seed = 1;
    LightStrategy strategy = LightStrategy::Mis;
    int rouletteBounce = 3;       // from which on Russian roulette ends paths of little weight
    std::optional<Portal> portal; // is sampled for a quarter of the rays that leave points before it
    int threads = 0;              // 0 = all; the picture does not depend on it
};

class PathTracer {
public:
    explicit PathTracer(const Scene& scene); // which must outlive it

    ImageEstimate render(const Camera& camera, const RenderSettings& settings) const;

private:
    // The path up to a ray: what its estimate still needs of it.
    struct Walk {
        int edge = 0;            // number d of the ray, 0 = from the camera
        double pdf = 0.0;        // with which scatter() sampled its direction, 1/sr; unused at edge 0
        double importance = 1.0; // largest component of the path's share of light, for Russian roulette
        Media media{};           // that the ray begins in
    };
    struct Estimator {
        const RenderSettings& settings;
        Random& random;
    };
    // Radiance from where a ray comes, whatever it passes straight on its way.
    Vec3 incident(const Ray& ray, const Walk& walk, const Estimator& estimator) const;
    // What a hit scatters towards the ray, of which `share` arrives.
    Vec3 scattered(const Ray& ray, const Hit& hit, const Walk& walk, double share,
                   const Estimator& estimator) const;
    Vec3 direct(const SurfacePoint& point, const Estimator& estimator) const;
    Vec3 directPunctual(const SurfacePoint& point, const Estimator& estimator) const;
    Vec3 indirect(const SurfacePoint& point, const Walk& walk, const Estimator& estimator) const;
    // The direction of an indirect ray, in the world, by the BSDF or towards the portal; its pdf is that of
    // the mixture (one-sample model with the balance heuristic).
    BsdfSample scatter(const SurfacePoint& point, const Estimator& estimator) const;
    double scatterPdf(const SurfacePoint& point, const Vec3& direction, const Estimator& estimator) const;
    // Share of light that passes straight on from a point to what lies at the distance, media included.
    Vec3 visibility(const SurfacePoint& point, const Vec3& direction, double distance) const;

    const Scene* scene_;
    Bvh bvh_;
    Lights lights_;
    bool letsPass_; // some material does
};

} // namespace irradia::reference
