// The time of frames as programs read it: the columns of the papers' cost table and every pass.
#pragma once

#include "samples/session/render_session.h"
#include <nlohmann/json.hpp>

namespace irradia {

// {"device", "driver", "width", "height", "frames", "milliseconds": {trace_shade, query, train, other,
// total}, "rays", "paths_per_second", "records", "memory_bytes", "passes": [{name, p50, p90, runs}]}.
// Milliseconds are medians per frame; the columns sum GPU time, total is wall clock, other what lies between.
nlohmann::ordered_json frameStats(RenderSession& session);

// The same as a table on stderr: one line per pass with its share of the frame.
void printFrameStats(RenderSession& session);

} // namespace irradia
