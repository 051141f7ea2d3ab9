#include "bench_mlp_report.h"
#include "bench_mlp_traffic.h"
#include "bench_tools.h"
#include "samples/support/standard_streams.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using Json = nlohmann::ordered_json;

const char* modeOf(const MlpCase& what) {
    return what.isTraining ? "training" : "inference";
}

double rowRate(const MlpResult& result) {
    return result.rows / result.seconds;
}

double bandwidth(const MlpResult& result) {
    return 1e-9 * rowRate(result) * trafficOf(result.what, result.rows).fused;
}

Json orNull(double value) {
    return value > 0 && std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json identity(const MlpCase& what) {
    return {{"width", what.shape.width},   {"hidden", what.shape.hiddenLayers},
            {"inputs", what.shape.inputs}, {"outputs", what.shape.outputs},
            {"form", nameOf(what.form)},   {"precision", nameOf(what.precision)},
            {"mode", modeOf(what)}};
}

Json passesOf(const MlpResult& result) {
    Json passes = Json::array();
    for (const Profiler::Row& row : result.times)
        passes.push_back({{"name", row.name}, {"p50", row.p50}, {"p90", row.p90}});
    return passes;
}

Json toJson(const MlpResult& result) {
    const RowTraffic traffic = trafficOf(result.what, result.rows);
    Json json = identity(result.what);
    json["rows"] = result.rows;
    json["rows_per_second"] = rowRate(result);
    json["gflops"] = result.gflops;
    json["peak_ratio"] = orNull(result.peakRatio);
    json["textbook_ratio"] = result.textbookRatio;
    json["onednn_ratio"] = result.onednnRatio ? Json(*result.onednnRatio) : Json(nullptr);
    json["textbook_gflops"] = result.textbookGflops;
    json["onednn_gflops"] = orNull(result.onednnGflops);
    json["bytes_per_row"] = traffic.fused;
    json["bytes_per_row_unfused"] = traffic.unfused;
    json["gb_per_second"] = bandwidth(result);
    json["milliseconds"] = {{"wall", 1e3 * result.wall}, {"passes", orNull(1e3 * result.passes)}};
    if (!result.what.isTraining) json["difference"] = result.difference;
    json["passes"] = passesOf(result);
    return json;
}

void printPasses(const MlpResult& result) {
    for (const Profiler::Row& row : result.times)
        printResult("    {:<36}{:>9.3f} ms  {:>5.1f} %\n", row.name, row.p50, 0.1 * row.p50 / result.seconds);
}

double peakOf(const std::vector<MlpResult>& results) {
    std::vector<double> peaks;
    for (const MlpResult& result : results) peaks.push_back(result.peakGflops);
    return peaks.empty() ? 0.0 : median(peaks);
}

} // namespace

void printHeading(const MlpMachine& machine) {
    printResult("{}, subgroups of {}; yardsticks on {} threads{}\n", machine.device, machine.subgroup,
                machine.threads,
                machine.copyGbps > 0 ? fmt::format("; copies {:.1f} GB/s", machine.copyGbps) : "");
    printResult("Ratios: medians of the rounds' ratios of speed, by the device's clock over the passes.\n\n");
    printResult("{:<7}{:<10}{:<10}{:<6}{:>9}{:>9}{:>9}{:>9}{:>8}{:>10}{:>11}{:>9}{:>10}{:>8}\n", "shape",
                "mode", "form", "type", "wall ms", "passes", "Mrows/s", "GFLOP/s", "of peak", "textbook",
                "oneDNN", "B/row", "unfused", "GB/s");
}

void printResults(const std::vector<MlpResult>& results, bool withPasses) {
    for (const MlpResult& result : results) {
        const RowTraffic traffic = trafficOf(result.what, result.rows);
        printResult(
            "{:<7}{:<10}{:<10}{:<6}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.1f}{:>7.1f}%{:>9.1f}x{:>11}{:>9.0f}{:>10.0f}"
            "{:>8.2f}\n",
            nameOf(result.what.shape), modeOf(result.what), nameOf(result.what.form),
            nameOf(result.what.precision), 1e3 * result.wall, 1e3 * result.passes, 1e-6 * rowRate(result),
            result.gflops, 1e2 * result.peakRatio, result.textbookRatio,
            result.onednnRatio ? fmt::format("{:.3f}x", *result.onednnRatio) : "not built", traffic.fused,
            traffic.unfused, bandwidth(result));
        if (withPasses) printPasses(result);
    }
    if (results.empty()) return;
    const MlpResult& any = results.front();
    double difference = 0;
    for (const MlpResult& result : results) difference = std::max(difference, result.difference);
    printResult("    {} rows; peak {:.1f} GFLOP/s, textbook {:.2f}", any.rows, any.peakGflops,
                any.textbookGflops);
    if (any.onednnRatio) printResult(", oneDNN {:.1f}", any.onednnGflops);
    if (!any.what.isTraining)
        printResult("; results differ from the textbook's by {:.1e} at most", difference);
    printResult("\n");
    std::fflush(stdout);
}

void printCompileTimes(const std::vector<CompileTime>& times) {
    constexpr double kWorthALine = 0.05; // seconds
    printResult("{:<7}{:<10}{:<10}{:<6}{:<20}{:>9}{:>9}\n", "shape", "mode", "form", "type",
                "first execution of", "cold s", "cached s");
    const CompileTime *cold = nullptr, *cached = nullptr; // the slowest
    for (const CompileTime& time : times) {
        if (std::max(time.cold, time.cached) > kWorthALine)
            printResult("{:<7}{:<10}{:<10}{:<6}{:<20}{:>9.3f}{:>9.3f}\n", nameOf(time.what.shape),
                        modeOf(time.what), nameOf(time.what.form), nameOf(time.what.precision), time.kernel,
                        time.cold, time.cached);
        if (time.kernel == kPipelines) continue;
        if (!cold || time.cold > cold->cold) cold = &time;
        if (!cached || time.cached > cached->cached) cached = &time;
    }
    if (!cold) return;
    printResult("Slowest kernel: {} in {:.3f} s cold, {} in {:.3f} s cached. Others take below {} s.\n",
                cold->kernel, cold->cold, cached->kernel, cached->cached, kWorthALine);
}

Json toJson(const std::vector<MlpResult>& results, const MlpMachine& machine) {
    Json json;
    json["mlp"] = Json::array();
    for (const MlpResult& result : results) json["mlp"].push_back(toJson(result));
    json["peak_gflops"] = orNull(peakOf(results));
    json["copy_gb_per_second"] = orNull(machine.copyGbps);
    json["threads"] = machine.threads;
    json["subgroup_size"] = machine.subgroup;
    json["device"] = machine.device;
    return json;
}

Json toJson(const std::vector<CompileTime>& times, const std::string& device) {
    Json json;
    json["compile_times"] = Json::array();
    for (const CompileTime& time : times) {
        Json entry = identity(time.what);
        entry["kernel"] = time.kernel;
        entry["cold_seconds"] = time.cold;
        entry["cached_seconds"] = time.cached;
        json["compile_times"].push_back(entry);
    }
    json["device"] = device;
    return json;
}

} // namespace irradia
