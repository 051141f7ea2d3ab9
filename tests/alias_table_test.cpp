// The alias method's table: the masses that a uniform choice and one coin make of it.
#include "engine/scene/lights/alias_table.h"
#include "tests/reference/random.h"
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numeric>

using namespace irradia;

namespace {

// Probability with which each entry is chosen: (keep + what others pass on to it) / n.
std::vector<double> chosen(const std::vector<AliasEntry>& table) {
    std::vector<double> mass(table.size());
    for (size_t i = 0; i < table.size(); ++i) {
        REQUIRE((table[i].keep >= 0.0f && table[i].keep <= 1.0f));
        REQUIRE(table[i].alias < table.size());
        mass[i] += table[i].keep;
        mass[table[i].alias] += 1.0 - table[i].keep;
    }
    for (double& m : mass) m /= static_cast<double>(table.size());
    return mass;
}

void checkMasses(const std::vector<double>& weights) {
    const std::vector<AliasEntry> table = buildAliasTable(weights);
    REQUIRE(table.size() == weights.size());
    const std::vector<double> mass = chosen(table);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto count = static_cast<double>(weights.size());
    std::vector<int> takers(weights.size());
    for (const AliasEntry& entry : table) takers[entry.alias] += entry.keep < 1.0f;
    double total = 0.0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const double exact = weights[i] / sum;
        INFO("entry " << i << " of " << weights.size() << ": " << mass[i] << ", exact " << exact);
        REQUIRE(std::abs(table[i].mass - exact) <= 1e-14 * exact);
        // Each keep probability is rounded to a float, at most 2^-25 off: the entry's own and those of its
        // takers. The sums of the construction round in double precision, as large as the largest mass.
        REQUIRE(std::abs(mass[i] - exact) <= ((1 + takers[i]) * 0x1p-25 + 1e-9) / count);
        if (weights[i] == 0.0) REQUIRE(mass[i] == 0.0);
        total += table[i].mass;
    }
    CHECK(std::abs(total - 1.0) <= 2.0 * count * 0x1p-53); // of two sums of as many terms
}

} // namespace

TEST_CASE("an alias table chooses in proportion to the weights") {
    reference::Random random(31);
    for (const size_t count : {1, 2, 3, 7, 64, 1000, 100000}) {
        std::vector<double> weights(count);
        for (double& w : weights) w = random.uniform();
        checkMasses(weights);
        for (double& w : weights) w = std::exp(40.0 * random.uniform() - 20.0); // seventeen decades
        checkMasses(weights);
        for (double& w : weights) w = 3.0;
        checkMasses(weights);
    }
}

TEST_CASE("entries without weight are never chosen") {
    reference::Random random(32);
    std::vector<double> weights(1000);
    for (double& w : weights) w = random.uniform() < 0.7 ? 0.0 : random.uniform();
    checkMasses(weights);
    std::fill(weights.begin(), weights.end(), 0.0);
    weights[123] = 1e-30;
    checkMasses(weights);
}

TEST_CASE("one entry may outweigh all others together") {
    std::vector<double> weights(100000, 1e-9);
    weights[777] = 1e6; // a sun
    checkMasses(weights);
}

TEST_CASE("without any weight the choice is uniform, and a table of nothing is empty") {
    const std::vector<double> mass = chosen(buildAliasTable(std::vector<double>(10, 0.0)));
    for (const double m : mass) CHECK(std::abs(m - 0.1) < 1e-7);
    CHECK(buildAliasTable({}).empty());
}
