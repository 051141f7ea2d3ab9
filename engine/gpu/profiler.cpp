#include "engine/gpu/profiler.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradia {
namespace {

constexpr size_t kMostFrames = 4096; // kept: even, so that the next to keep follows the last

// The smallest value that at least `share` of all values do not exceed (nearest rank).
double quantile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

double median(const std::vector<double>& sorted) {
    if (sorted.empty()) return 0;
    const size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

Profiler::Row summary(const std::string& name, std::vector<double> values, uint64_t runs) {
    std::sort(values.begin(), values.end());
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    const double mean = values.empty() ? 0.0 : sum / static_cast<double>(values.size());
    return {name, median(values), quantile(values, 0.9), mean, runs};
}

} // namespace

void Profiler::record(std::string_view pass, double milliseconds) {
    auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == pass; });
    if (found == entries_.end()) {
        // A pass that first runs late took no time in the frames before.
        entries_.push_back({std::string(pass), 0, 0, 0, std::vector<double>(wall_.size(), 0.0)});
        found = entries_.end() - 1;
    }
    found->current += milliseconds;
    ++found->runs;
}

void Profiler::endFrame(double wallMilliseconds) {
    const bool isKept = frames_++ % stride_ == 0;
    if (isKept) wall_.push_back(wallMilliseconds);
    for (Entry& entry : entries_) {
        entry.last = std::exchange(entry.current, 0);
        if (isKept) entry.frames.push_back(entry.last);
    }
    if (wall_.size() == kMostFrames) thinOut();
}

// Drops every second of the frames that are kept.
void Profiler::thinOut() {
    const auto halve = [](std::vector<double>& values) {
        for (size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
        values.resize((values.size() + 1) / 2);
    };
    halve(wall_);
    for (Entry& entry : entries_) halve(entry.frames);
    stride_ *= 2;
}

void Profiler::reset() {
    *this = {};
}

std::vector<Profiler::Row> Profiler::rows() const {
    std::vector<Row> rows;
    for (const Entry& entry : entries_) rows.push_back(summary(entry.name, entry.frames, entry.runs));
    return rows;
}

Profiler::Row Profiler::wall() const {
    return summary("total", wall_, frames_);
}

double Profiler::lastFrame(std::string_view pass) const {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == pass; });
    return found == entries_.end() ? 0 : found->last;
}

} // namespace irradia
