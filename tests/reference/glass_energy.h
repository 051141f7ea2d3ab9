// How much light a white rough glass keeps in single scattering: the directional albedo E(mu) of reflection
// and transmission together (base 1, all of the specular layer, F0 by Fresnel's equations) and its mean over
// a hemisphere, as the compensation of Kulla and Conty 2017, "Revisiting physically based shading at
// Imageworks", needs them.
#pragma once

#include <array>
#include <memory>
#include <mutex>

namespace irradia::reference {

// One side of an interface; V and L of this side share it. E comes from a grid in alpha and mu with cubic
// interpolation, error < 2e-5 (reference_glass_energy_test shows it). The grid's rows are made when they are
// first needed, by any thread: some 20 ms each.
class GlassEnergy {
public:
    // Of the side of V, eta = n_l / n_v. Kept for the life of the program.
    static const GlassEnergy& ofInterface(double eta);
    // Of a sheet, where what is transmitted leaves as what is reflected does: the Fresnel term does not
    // matter.
    static const GlassEnergy& ofSheet();

    double albedo(double mu, double alpha) const; // E; alpha in [1e-3, 1]
    double average(double alpha) const;           // 2 * integral of E mu dmu

    explicit GlassEnergy(double eta); // 0 = a sheet

private:
    static constexpr int kAlphas = 80;
    static constexpr int kCosines = 160;
    struct Row {
        std::once_flag once;
        std::array<double, kCosines> albedo{}; // over the column of warp()
        double average = 0.0;
    };

    double exactAlbedo(double mu, double alpha) const;
    double warp(double mu, double alpha) const; // [0, 1] onto [0, 1], steep where E bends
    double unwarp(double column, double alpha) const;
    const Row& row(int index) const;
    void fill(Row& row, double alpha) const;

    double eta_;
    std::unique_ptr<std::array<Row, kAlphas>> rows_;
};

} // namespace irradia::reference
