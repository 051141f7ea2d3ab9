#include "tests/reference/encodings.h"

#include <complex>

namespace irradia::reference {

namespace {

void append(Values& values, const Values& more) {
    values.insert(values.end(), more.begin(), more.end());
}

std::size_t roundUp(std::size_t n, std::size_t multiple) {
    return (n + multiple - 1) / multiple * multiple;
}

// Differences of a distribution function of the distance from x, in kernel widths, at the bins' borders.
template <typename Distribution>
Values binMasses(double x, int bins, Distribution&& distribution) {
    Values masses;
    for (int i = 0; i < bins; ++i)
        masses.push_back(distribution(i + 1 - x * bins) - distribution(i - x * bins));
    return masses;
}

// P(l, m)(z) / sqrt(1 - z^2)^m for all l < degree, without the phase (DLMF 14.10.3 in l).
Values legendre(double z, int m, int degree) {
    Values p(static_cast<std::size_t>(degree), 0.0);
    double first = 1.0; // (2 m - 1)!!
    for (int i = 1; i <= m; ++i) first *= 2 * i - 1;
    for (int l = m; l < degree; ++l) {
        const auto at = static_cast<std::size_t>(l);
        if (l == m) p[at] = first;
        if (l > m)
            p[at] = ((2 * l - 1) * z * p[at - 1] - (l > m + 1 ? (l + m - 1) * p[at - 2] : 0.0)) / (l - m);
    }
    return p;
}

// sqrt((2 l + 1) (l - m)! / (4 pi (l + m)!)), with the sqrt 2 of the real form for m > 0.
double normalisation(int l, int m) {
    const double factorials = std::tgamma(l - m + 1.0) / std::tgamma(l + m + 1.0);
    return std::sqrt((m > 0 ? 2.0 : 1.0) * (2 * l + 1) / (4.0 * kPi) * factorials);
}

} // namespace

Values identity(const Values& x, double scale, double offset) {
    Values values;
    for (const double v : x) values.push_back(scale * v + offset);
    return values;
}

Values frequency(const Values& x, int frequencies) {
    Values values;
    for (const double v : x)
        for (int k = 0; k < frequencies; ++k) {
            const double phase = kPi * std::remainder(std::ldexp(v, k), 2.0);
            append(values, {std::sin(phase), std::cos(phase)});
        }
    return values;
}

double triangle(double x) {
    const double wrapped = x - 2.0 * std::floor(x / 2.0);
    return 2.0 * std::abs(wrapped - 1.0) - 1.0;
}

Values triangleWave(const Values& x, int frequencies) {
    Values values;
    for (const double v : x)
        for (int k = 0; k < frequencies; ++k) values.push_back(triangle(std::ldexp(v, k)));
    return values;
}

Values oneBlobGaussian(double x, int bins) {
    return binMasses(x, bins, [](double u) { return 0.5 * (1.0 + std::erf(u / std::numbers::sqrt2)); });
}

Values oneBlobQuartic(double x, int bins) {
    return binMasses(x, bins, [](double distance) {
        const double u = std::clamp(distance, -1.0, 1.0), u3 = u * u * u;
        return 0.5 + 15.0 / 16.0 * (u - 2.0 / 3.0 * u3 + u3 * u * u / 5.0);
    });
}

Values oneBlob(const Values& x, int bins, bool gaussian) {
    Values values;
    for (const double v : x) append(values, gaussian ? oneBlobGaussian(v, bins) : oneBlobQuartic(v, bins));
    return values;
}

Values sphericalHarmonics(const Vec3& direction, int degree) {
    Values values(static_cast<std::size_t>(degree * degree), 0.0);
    std::complex<double> power = 1.0; // (-1)^m sin(polar)^m exp(i m azimuth)
    for (int m = 0; m < degree; ++m) {
        const Values p = legendre(direction.z, m, degree);
        for (int l = m; l < degree; ++l) {
            const double magnitude = normalisation(l, m) * p[static_cast<std::size_t>(l)];
            values[static_cast<std::size_t>(l * (l + 1) + m)] = magnitude * power.real();
            if (m > 0) values[static_cast<std::size_t>(l * (l + 1) - m)] = magnitude * power.imag();
        }
        power *= -std::complex<double>(direction.x, direction.y);
    }
    return values;
}

std::vector<std::size_t> partOffsets(const std::vector<std::size_t>& widths) {
    std::vector<std::size_t> offsets;
    std::size_t next = 0;
    for (const std::size_t width : widths) {
        offsets.push_back(next);
        next = roundUp(next + width, 4);
    }
    return offsets;
}

Values composite(const std::vector<Values>& parts) {
    Values values;
    for (const Values& part : parts) {
        values.resize(roundUp(values.size(), 4), 1.0);
        append(values, part);
    }
    values.resize(roundUp(values.size(), 16), 1.0);
    return values;
}

} // namespace irradia::reference
