// What white glass loses of a direction by single scattering: 1 - E, the share that micro-facets reflect or
// refract into a facet beside them, by height-correlated masking (Heitz 2014), over GGX's visible normals
// (Walter et al. 2007).
#pragma once

#include <vector>

namespace irradia {

// A view direction of cosine mu > 0 and a roughness: its facets, drawn once for glass of any index.
class GlassEnergy {
public:
    GlassEnergy(double mu, double alpha);

    // 1 - E: the facets' Fresnel is Schlick's, with the cosine in the thinner medium and F0 = ((eta - 1) /
    // (eta + 1))^2; all light is reflected beyond the critical angle.
    double loss(double eta) const;

private:
    struct Facet {
        double cosine;    // of the view direction to the facet's normal
        double sine2;     // 1 - cosine^2
        double height;    // z of that normal
        double reflected; // G2 / G1 of what the facet reflects, 0 below the horizon
    };

    double maskingRatio(double lz) const; // G2 / G1 of a direction of that cosine on its side, 0 below

    double mu_, alpha_, root_;
    std::vector<Facet> facets_;
};

} // namespace irradia
