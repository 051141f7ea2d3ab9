#include "tests/reference/sobol.h"

#include <cstddef>
#include <vector>

namespace irradia::reference {

namespace {

constexpr int kPlaces = 16; // of numbers

uint32_t mirrored(uint32_t x) {
    uint32_t y = 0;
    for (int i = 0; i < 32; ++i) y |= (x >> i & 1u) << (31 - i);
    return y;
}

struct Polynomial {
    int degree;
    std::vector<int> inner;      // coefficients of x^(degree - 1) .. x
    std::vector<uint32_t> first; // odd numbers m_1 .. m_degree
};

// The first coordinate has none: its directions are 2^-1, 2^-2, ...
const Polynomial kPolynomials[] = {{0, {}, {}}, {1, {}, {1}}, {2, {1}, {1, 3}}, {3, {0, 1}, {1, 3, 1}}};

// m_k = 2 a_1 m_(k-1) + 2^2 a_2 m_(k-2) + ... + 2^s m_(k-s) + m_(k-s), sums without carry (Joe and Kuo 2008,
// equation 2).
std::vector<uint32_t> directions(const Polynomial& p) {
    if (p.degree == 0) return std::vector<uint32_t>(kPlaces, 1u);
    std::vector<uint32_t> m = p.first;
    while (m.size() < kPlaces) {
        const std::size_t k = m.size();
        uint32_t next = m[k - p.degree] ^ (m[k - p.degree] << p.degree);
        for (int i = 1; i < p.degree; ++i)
            if (p.inner[i - 1] != 0) next ^= m[k - i] << i;
        m.push_back(next);
    }
    return m;
}

} // namespace

Words pcg4d(Words v) {
    auto& [x, y, z, w] = v;
    for (uint32_t& word : v) word = word * 1664525u + 1013904223u;
    const auto mix = [&] {
        x += y * w;
        y += z * x;
        z += x * y;
        w += y * z;
    };
    mix();
    for (uint32_t& word : v) word ^= word >> 16;
    mix();
    return v;
}

uint32_t sobol(uint32_t number, int dimension) {
    static const std::array<std::vector<uint32_t>, 4> m{
        directions(kPolynomials[0]), directions(kPolynomials[1]), directions(kPolynomials[2]),
        directions(kPolynomials[3])};
    uint32_t fraction = 0;
    for (int k = 0; k < kPlaces; ++k)
        if ((number >> k & 1u) != 0) fraction ^= m.at(dimension)[k] << (31 - k); // m_k / 2^k
    return fraction;
}

uint32_t nestedScramble(uint32_t fraction, uint32_t key) {
    uint32_t x = mirrored(fraction);
    x ^= x * 0x3d20adeau;
    x += key;
    x *= key >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return mirrored(x);
}

SobolKeys sobolKeys(const Words& values) {
    return {values, (values[0] ^ values[2]) * 0x9e3779b9u};
}

Words shuffledScrambledSobol(uint32_t number, const SobolKeys& keys) {
    // A number of 16 places stands for a fraction whose later places are none of its own.
    const uint32_t shuffled = nestedScramble(number << kPlaces, keys.order) >> kPlaces;
    Words point{};
    for (int d = 0; d < 4; ++d) point[d] = nestedScramble(sobol(shuffled, d), keys.values[d]);
    return point;
}

PixelKeys pixelKeys(uint32_t pixel, uint32_t width, uint32_t group, uint32_t block, uint32_t seed) {
    const uint32_t x = pixel % width % 16, y = pixel / width % 16;
    uint32_t place = 0;
    for (int i = 0; i < 4; ++i) place |= (x >> i & 1u) << (2 * i) | (y >> i & 1u) << (2 * i + 1);
    const Words values = pcg4d({pixel - y * width - x, group, block + 0x80000000u, seed});
    return {sobolKeys(values), sobolKeys(pcg4d(values)), place};
}

Words pixelPoint(uint32_t number, const PixelKeys& keys) {
    Words point = shuffledScrambledSobol(number, keys.sequence);
    const Words shift = shuffledScrambledSobol(keys.place, keys.shift);
    for (int d = 0; d < 4; ++d) point[d] ^= shift[d];
    return point;
}

} // namespace irradia::reference
