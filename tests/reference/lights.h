// All lights of a scene: emissive triangles, chosen by power and sampled uniformly over their area, and the
// environment.
#pragma once

#include "tests/reference/environment_light.h"
#include "tests/reference/random.h"
#include "tests/reference/surface.h"

namespace irradia::reference {

struct LightSample {
    Vec3 direction{0.0};   // unit, from the receiver
    double distance = 0.0; // 1e300 = the environment
    Vec3 radiance{0.0};    // towards the receiver, unoccluded
    double pdf = 0.0;      // per solid angle, choice of the light included; 0 = no sample
};

class Lights {
public:
    explicit Lights(const Scene& scene); // which must outlive it

    LightSample sample(const Vec3& receiver, Random& random) const;

    // Density with which sample() finds that point of a triangle, `distance` away along the unit direction.
    double trianglePdf(uint32_t triangle, const Vec3& direction, double distance) const;
    // The same had the triangle been chosen with another chance.
    double trianglePdf(uint32_t triangle, const Vec3& direction, double distance, double chance) const;
    double environmentPdf(const Vec3& direction) const;

    Vec3 environment(const Vec3& direction) const { return environment_.radiance(direction); }

private:
    LightSample sampleTriangle(const Vec3& receiver, Random& random) const;

    const Scene* scene_;
    std::vector<TriangleShape> shapes_;
    DiscreteDistribution
        triangles_; // by power: area times mean luminance, twice that of double-sided materials
    EnvironmentLight environment_;
    double environmentShare_; // of samples
};

} // namespace irradia::reference
