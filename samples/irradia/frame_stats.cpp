#include "frame_stats.h"

#include "engine/log.h"
#include <fmt/format.h>

namespace irradia {

nlohmann::ordered_json frameStats(RenderSession& session) {
    const DeviceDescription& device = session.device().description();
    const Profiler::Row wall = session.profiler().wall();
    double traceShade = 0.0, query = 0.0, train = 0.0;
    auto passes = nlohmann::ordered_json::array();
    for (const Profiler::Row& row : session.profiler().rows()) {
        double& column = row.name.starts_with("query/")   ? query
                         : row.name.starts_with("train/") ? train
                                                          : traceShade;
        column += row.p50;
        passes.push_back({{"name", row.name}, {"p50", row.p50}, {"p90", row.p90}, {"runs", row.runs}});
    }
    const RendererStatistics statistics = session.statistics();
    const double paths = double(session.size().x) * session.size().y * session.request().samplesPerFrame;
    return {{"scene", session.scene().name},
            {"method", session.request().method},
            {"device", device.name},
            {"driver", device.driver},
            {"width", session.size().x},
            {"height", session.size().y},
            {"frames", session.profiler().frames()},
            {"samples_per_frame", session.request().samplesPerFrame},
            {"milliseconds",
             {{"trace_shade", traceShade},
              {"query", query},
              {"train", train},
              {"other", wall.p50 - traceShade - query - train},
              {"total", wall.p50},
              {"total_p90", wall.p90}}},
            {"rays", statistics.rays},
            {"paths_per_second", wall.p50 > 0 ? paths / wall.p50 * 1e3 : 0.0},
            {"records", statistics.records},
            {"memory_bytes", session.device().memoryUsed()},
            {"passes", passes}};
}

void printFrameStats(RenderSession& session) {
    const nlohmann::ordered_json stats = frameStats(session);
    const double total = stats["milliseconds"]["total"];
    logLine("{:<24}{:>10}{:>10}{:>8}", "pass", "p50 ms", "p90 ms", "share");
    for (const auto& row : stats["passes"])
        logLine("{:<24}{:>10.2f}{:>10.2f}{:>7.1f}%", row["name"].get<std::string>(), row["p50"].get<double>(),
                row["p90"].get<double>(), 100.0 * row["p50"].get<double>() / total);
    logLine("{:<24}{:>10.2f}{:>10.2f}", "total (wall clock)", total,
            stats["milliseconds"]["total_p90"].get<double>());
    const auto& columns = stats["milliseconds"];
    logLine("trace & shade {:.2f}, query {:.2f}, training {:.2f}, other {:.2f} ms",
            columns["trace_shade"].get<double>(), columns["query"].get<double>(),
            columns["train"].get<double>(), columns["other"].get<double>());
    logLine("{:.3f} M paths/s, {:.2f} M rays/s", stats["paths_per_second"].get<double>() * 1e-6,
            stats["rays"].get<double>() / total * 1e-3);
}

} // namespace irradia
