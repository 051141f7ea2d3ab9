#include "bench_mlp_rounds.h"
#include "bench_tools.h"
#include "engine/error.h"
#include "engine/log.h"
#include "samples/support/interrupt.h"
#include "samples/yardsticks/cpu_peak.h"
#include "samples/yardsticks/device_peak.h"
#include "samples/yardsticks/mlp_yardstick.h"
#include <algorithm>
#include <cmath>

namespace irradia {
namespace {

// Textbook kernels on a CPU get this part of the rows: their speed does not depend on it, the bench's length
// does.
constexpr uint32_t kTextbookPart = 8;

struct Contender {
    MlpCase what;
    std::unique_ptr<MlpRun> run;
    std::vector<double> wall, passes, gflops, peakRatios, textbookRatios, onednnRatios; // by round
};

// Rates in a round of what all contenders are compared with.
struct Yardsticks {
    std::unique_ptr<MlpYardstick> textbook, onednn;
    uint32_t textbookRows = 0;
    std::vector<double> peak, textbookRows_s, onednnRows_s;
};

std::vector<Contender> startContenders(Device& device, const MlpGroup& group, const MlpProblem& problem) {
    std::vector<Contender> all;
    for (const NetworkForm form : group.forms)
        for (const Precision precision : group.precisions) {
            const MlpCase what{group.shape, form, precision, group.isTraining, group.rowsPerLane};
            try {
                all.push_back({what, startCase(device, what, problem)});
            } catch (const Error& error) {
                if (error.code() != ExitCode::BadData) throw;
                logLine("{} {} {}: left out: {}", nameOf(group.shape), nameOf(form), nameOf(precision),
                        error.what());
            }
        }
    return all;
}

double yardstickTime(MlpYardstick& yardstick, bool isTraining) {
    return median(repeated([&] { return isTraining ? yardstick.train() : yardstick.infer(); }));
}

void measure(Contender& contender) {
    std::vector<double> wall, passes;
    for (const MlpTime& time : repeated([&] { return contender.run->run(); })) {
        wall.push_back(time.wall);
        passes.push_back(time.passes);
    }
    contender.wall.push_back(median(wall));
    contender.passes.push_back(median(passes));
}

double lastSeconds(const Contender& contender) {
    return contender.passes.back() > 0 ? contender.passes.back() : contender.wall.back();
}

void measureYardsticks(Device& device, Yardsticks& yardsticks, const MlpGroup& group, uint32_t threads) {
    yardsticks.peak.push_back(device.isCpu() ? measureCpuPeak(threads).gflops : measureDevicePeak(device));
    yardsticks.textbookRows_s.push_back(yardsticks.textbookRows /
                                        yardstickTime(*yardsticks.textbook, group.isTraining));
    if (yardsticks.onednn)
        yardsticks.onednnRows_s.push_back(group.rows / yardstickTime(*yardsticks.onednn, group.isTraining));
}

void compare(Contender& contender, const Yardsticks& yardsticks, uint32_t rows) {
    const double speed = rows / lastSeconds(contender);
    contender.gflops.push_back(1e-9 * flopsPerRow(contender.what) * speed);
    contender.peakRatios.push_back(contender.gflops.back() / yardsticks.peak.back());
    contender.textbookRatios.push_back(speed / yardsticks.textbookRows_s.back());
    if (yardsticks.onednn) contender.onednnRatios.push_back(speed / yardsticks.onednnRows_s.back());
}

double difference(const std::vector<float>& results, const std::vector<float>& expected) {
    double most = 0, largest = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        most = std::max(most, double(std::abs(results[i] - expected[i])));
        largest = std::max(largest, double(std::abs(expected[i])));
    }
    return most / largest;
}

MlpResult resultOf(const Contender& contender, const Yardsticks& yardsticks, uint32_t rows) {
    MlpResult result;
    const double rowGflops = 1e-9 * flopsPerRow(contender.what);
    result.what = contender.what;
    result.rows = rows;
    result.wall = median(contender.wall);
    result.passes = median(contender.passes);
    result.seconds = result.passes > 0 ? result.passes : result.wall;
    result.gflops = median(contender.gflops);
    result.peakGflops = median(yardsticks.peak);
    result.peakRatio = median(contender.peakRatios);
    result.textbookRatio = median(contender.textbookRatios);
    result.textbookGflops = rowGflops * median(yardsticks.textbookRows_s);
    if (yardsticks.onednn) {
        result.onednnRatio = median(contender.onednnRatios);
        result.onednnGflops = rowGflops * median(yardsticks.onednnRows_s);
    }
    result.times = contender.run->passes();
    return result;
}

} // namespace

std::vector<MlpResult> runRounds(Device& device, const MlpGroup& group, uint32_t rounds, uint32_t threads) {
    const MlpProblem problem = makeMlpProblem(group.shape, group.rows);
    std::vector<Contender> contenders = startContenders(device, group, problem);
    if (contenders.empty()) return {};
    const MlpProblem part =
        firstRows(problem, device.isCpu() ? std::max(1u, group.rows / kTextbookPart) : group.rows);
    Yardsticks yardsticks{makeTextbookMlp(device, part), makeOnednnMlp(problem, threads), part.rows};

    // The first runs compile, and are compared before any weight has changed.
    yardsticks.textbook->infer();
    std::vector<double> differences;
    for (Contender& contender : contenders) {
        contender.run->run();
        differences.push_back(
            group.isTraining ? 0.0 : difference(contender.run->results(), yardsticks.textbook->results()));
    }
    if (group.isTraining) yardsticks.textbook->train();

    stopIfInterrupted();
    for (uint32_t round = 0; round < rounds && (round == 0 || !interruptedBy()); ++round) {
        measureYardsticks(device, yardsticks, group, threads);
        for (Contender& contender : contenders) {
            measure(contender);
            compare(contender, yardsticks, group.rows);
        }
    }
    std::vector<MlpResult> results;
    for (size_t i = 0; i < contenders.size(); ++i) {
        results.push_back(resultOf(contenders[i], yardsticks, group.rows));
        results.back().difference = differences[i];
    }
    return results;
}

const char* nameOf(NetworkForm form) {
    return form == NetworkForm::Subgroup ? "subgroup" : form == NetworkForm::Workgroup ? "workgroup" : "auto";
}

const char* nameOf(Precision precision) {
    return precision == Precision::Half ? "half" : "float";
}

std::string nameOf(const MlpShape& shape) {
    return fmt::format("{}x{}", shape.width, shape.hiddenLayers);
}

} // namespace irradia
