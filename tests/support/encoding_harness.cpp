#include "tests/support/encoding_harness.h"

#include "tests/reference/random.h"
#include "tests/support/gradient_sums.h"
#include <cmath>
#include <fmt/format.h>

namespace irradia::test {

namespace {

std::vector<double> storedUniform(reference::Random& random, size_t count, double low, double high,
                                  Precision precision) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i)
        values.push_back(stored(low + (high - low) * random.uniform(), precision));
    return values;
}

// Unit vectors in place of the inputs of spherical harmonics.
void normaliseDirections(const EncodingTwin& twin, std::vector<double>& inputs, size_t perRow) {
    for (const EncodingTwin::Part& part : twin.parts()) {
        if (part.config.otype != "SphericalHarmonics") continue;
        for (size_t at = part.firstInput; at < inputs.size(); at += perRow) {
            double* d = &inputs[at];
            for (size_t i = 0; i < 3; ++i) d[i] = 4.0 / 3.0 * (d[i] - 0.5);
            const double length = std::hypot(d[0], d[1], d[2]);
            for (size_t i = 0; i < 3; ++i) d[i] = stored(d[i] / length, Precision::Float);
        }
    }
}

} // namespace

std::string EncodingCase::name() const {
    return fmt::format("{} of {} inputs, {}", describe(parts), inputs,
                       precision == Precision::Half ? "half" : "float");
}

EncodingHarness::EncodingHarness(const EncodingCase& made, double filling, uint32_t capacity, Device& device)
    : device_(device)
    , precision_(made.precision)
    , filling_(filling)
    , capacity_(capacity)
    , encoding_(device, made.parts, made.inputs, made.precision, made.touched)
    , twin_(made.parts, made.inputs, made.touched)
    , counters_(device, "counters", 2 * sizeof(uint32_t))
    , sums_(device, "gradient sums", std::max<uint64_t>(encoding_.sumBytes(), 16)) {}

EncodingBatch EncodingHarness::randomBatch(uint32_t count, uint64_t seed) const {
    reference::Random random(seed);
    EncodingBatch batch{
        count, storedUniform(random, size_t{count} * encoding_.inputs(), -0.25, 1.25, Precision::Float),
        storedUniform(random, size_t{count} * encoding_.width(), -1.0, 1.0, precision_)};
    normaliseDirections(twin_, batch.inputs, encoding_.inputs());
    return batch;
}

std::vector<double> EncodingHarness::randomFeatures(uint64_t seed) const {
    reference::Random random(seed);
    return storedUniform(random, encoding_.featureCount(), -1.0, 1.0, Precision::Float);
}

RowCount EncodingHarness::rows(uint32_t count) {
    upload<uint32_t>(device_, counters_, std::vector<uint32_t>{capacity_, count});
    return {counters_, 1, capacity_};
}

std::vector<double> EncodingHarness::encode(const EncodingBatch& batch, const std::vector<double>& features) {
    const Buffer inputs = rowBuffer(inputRows(), capacity_, batch.inputs, filling_, device_);
    const Buffer stored =
        makeBuffer(device_, "features", std::vector<float>(features.begin(), features.end()));
    const Buffer encoded = rowBuffer(encodedRows(), capacity_, {}, filling_, device_);
    FrameGraph graph(device_);
    encoding_.encode(graph, rows(batch.count), inputs, stored, encoded);
    graph.execute();
    return downloadRows(encoded, encodedRows(), batch.count, device_);
}

void EncodingHarness::accumulate(const EncodingBatch& batch, uint32_t times) {
    const Buffer inputs = rowBuffer(inputRows(), capacity_, batch.inputs, filling_, device_);
    const Buffer gradient = rowBuffer(encodedRows(), capacity_, batch.encodedGradient, filling_, device_);
    FrameGraph graph(device_);
    const RowCount count = rows(batch.count);
    for (uint32_t i = 0; i < times; ++i) encoding_.accumulateGradient(graph, count, inputs, gradient, sums_);
    graph.execute();
}

std::vector<double> EncodingHarness::takeGradient() {
    const auto words = download<int32_t>(device_, sums_, 2 * encoding_.featureCount());
    FrameGraph graph(device_);
    graph.fill(sums_, 0);
    graph.execute();
    return gradientsOf(words);
}

std::vector<double> EncodingHarness::gradient(const EncodingBatch& batch) {
    accumulate(batch);
    return takeGradient();
}

} // namespace irradia::test
