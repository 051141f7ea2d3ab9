#include "bench_mlp_cases.h"
#include "nrc/learning/batch_rows.h"
#include "nrc/learning/trainer.h"
#include "shared/network.h"
#include <chrono>
#include <glm/gtc/packing.hpp>

namespace irradia {
namespace {

uint32_t quadsOf(uint32_t values) {
    return (values + 3) / 4;
}

// Calls place(row, value, index) for every value, index being its place in a buffer of tiles.
template <typename Place>
void forEachInTiles(uint32_t rows, uint32_t values, const Place& place) {
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t i = 0; i < values; ++i)
            place(row, i, size_t(4) * gpu::quadIndex(row, i / 4, quadsOf(values)) + i % 4);
}

// Plain rows in the project's layout (shaders/shared/network.h).
template <typename Value, typename Convert>
Buffer tiledBuffer(Device& device, const std::string& name, const std::vector<float>& plain, uint32_t rows,
                   const Convert& convert) {
    const auto values = static_cast<uint32_t>(plain.size() / rows);
    std::vector<Value> tiled(size_t(4) * paddedRows(rows) * quadsOf(values));
    forEachInTiles(rows, values, [&](uint32_t row, uint32_t i, size_t index) {
        tiled[index] = convert(plain[size_t(row) * values + i]);
    });
    return makeBuffer(device, name, tiled);
}

Buffer singleRows(Device& device, const std::string& name, const std::vector<float>& plain, uint32_t rows) {
    return tiledBuffer<float>(device, name, plain, rows, [](float value) { return value; });
}

Buffer encodedRows(Device& device, const MlpProblem& problem, Precision precision) {
    if (precision == Precision::Float) return singleRows(device, "encoded", problem.inputs, problem.rows);
    return tiledBuffer<uint16_t>(device, "encoded", problem.inputs, problem.rows,
                                 [](float value) { return glm::packHalf1x16(value); });
}

NetworkConfig networkOf(const MlpCase& what) {
    NetworkConfig config;
    config.width = what.shape.width;
    config.hiddenLayers = what.shape.hiddenLayers;
    config.precision = what.precision;
    config.form = what.form;
    return config;
}

// The inputs as they are, mean squared error, Adam: what the yardsticks do.
ModelConfig modelOf(const MlpCase& what) {
    ModelConfig config;
    config.encoding = {makeEncoding("Identity")};
    config.network = networkOf(what);
    const AdamConstants adam;
    config.optimizer.learningRate = adam.learningRate;
    config.optimizer.beta1 = adam.beta1;
    config.optimizer.beta2 = adam.beta2;
    config.optimizer.epsilon = adam.epsilon;
    config.optimizer.l2 = 0.0;
    return config;
}

// The problem's weights with the rows of zeros that the last matrix is padded with.
std::vector<float> paddedWeights(const MlpProblem& problem, uint64_t count) {
    std::vector<float> weights = problem.weights;
    weights.resize(count);
    return weights;
}

class TimedGraph : public MlpRun {
public:
    explicit TimedGraph(Device& device)
        : graph_(device, &profiler_) {}

    MlpTime run() override {
        declare(graph_);
        const auto start = std::chrono::steady_clock::now();
        graph_.execute();
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        profiler_.endFrame(1e3 * wall);
        double passes = 0;
        for (const Profiler::Row& row : profiler_.rows()) passes += 1e-3 * profiler_.lastFrame(row.name);
        return {wall, passes};
    }

    std::vector<Profiler::Row> passes() const override { return profiler_.rows(); }

private:
    virtual void declare(FrameGraph& graph) = 0;
    Profiler profiler_;
    FrameGraph graph_;
};

class Evaluation final : public TimedGraph {
public:
    Evaluation(Device& device, const MlpCase& what, const MlpProblem& problem)
        : TimedGraph(device)
        , device_(device)
        , rows_(problem.rows)
        , network_(device, networkOf(what), what.shape.inputs, what.shape.outputs, what.rowsPerLane)
        , counters_(makeBuffer<uint32_t>(device, "counters", {problem.rows}))
        , encoded_(encodedRows(device, problem, what.precision))
        , packed_(device, "packed weights", network_.shape().packedBytes())
        , results_(device, "results",
                   uint64_t(paddedRows(rows_)) * network_.outputQuads() * sizeof(glm::vec4)) {
        const Buffer weights = makeBuffer(device, "weights", paddedWeights(problem, network_.weightCount()));
        FrameGraph packing(device);
        network_.pack(packing, weights, packed_);
        packing.execute();
    }

    std::vector<float> results() const override {
        const uint32_t outputs = network_.outputs();
        const auto tiled = download<float>(device_, results_, results_.bytes() / sizeof(float));
        std::vector<float> plain(size_t(rows_) * outputs);
        forEachInTiles(rows_, outputs, [&](uint32_t row, uint32_t i, size_t index) {
            plain[size_t(row) * outputs + i] = tiled[index];
        });
        return plain;
    }

private:
    void declare(FrameGraph& graph) override {
        network_.infer(graph, {counters_, 0, paddedRows(rows_)}, encoded_, packed_, results_);
    }

    Device& device_;
    uint32_t rows_;
    Network network_;
    Buffer counters_, encoded_, packed_, results_;
};

class Training final : public TimedGraph {
public:
    Training(Device& device, const MlpCase& what, const MlpProblem& problem)
        : TimedGraph(device)
        , rows_(problem.rows)
        , trainer_(device, modelOf(what), what.shape.inputs, what.shape.outputs,
                   TrainerOptions{paddedRows(rows_), gpu::kRowPadding, 1, {}})
        , counters_(makeBuffer<uint32_t>(device, "counters", {problem.rows}))
        , inputs_(singleRows(device, "inputs", problem.inputs, rows_))
        , targets_(singleRows(device, "targets", problem.targets, rows_)) {
        trainer_.setParameters(paddedWeights(problem, trainer_.parameterCount()));
    }

private:
    void declare(FrameGraph& graph) override {
        trainer_.train(graph, {{counters_, 0, paddedRows(rows_)}, inputs_, targets_});
    }

    uint32_t rows_;
    Trainer trainer_;
    Buffer counters_, inputs_, targets_;
};

} // namespace

std::unique_ptr<MlpRun> startCase(Device& device, const MlpCase& what, const MlpProblem& problem) {
    if (what.isTraining) return std::make_unique<Training>(device, what, problem);
    return std::make_unique<Evaluation>(device, what, problem);
}

double flopsPerRow(const MlpCase& what) {
    return (what.isTraining ? 6.0 : 2.0) * double(what.shape.multiplyAdds());
}

} // namespace irradia
