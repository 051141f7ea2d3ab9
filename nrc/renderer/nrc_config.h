// The knobs of rendering with a cache, as JSON:
//
//     {"base": "balanced",
//      "paths": {"spread": 0.01, "training_spread": 0.01, "unbiased_share": 0.0625,
//      "suffix_bounces": 8, "residual_share": 0},
//      "training": {"records": 65536, "min_records": 4096, "steps": 4, "self_training": "Ema",
//      "uniform_share": 0},
//      "adaptation": "off", or {"smoothing": 0.6, "threshold": 0.3, "full": 0.7, "most_steps": 16,
//      "shortest_ema": 0.9, "calming": 0.85, "youth": 512, "settling": 1024},
//      "factorise": "on", "shown": "Ema", "model": {...}}
//
// where "base" names the preset that all missing keys are inherited from (nrc/renderer/preset_base.h).
// Without it every key must be there but "training_spread" (then as "spread"), "end_depth" (none),
// "residual_share" and "uniform_share" (0). "model" is what nrc/learning/config.h describes, of
// gpu::kCacheInputs inputs; a file of it alone may have a "base" too.
#pragma once

#include "nrc/learning/config.h"
#include "nrc/learning/trainer.h"
#include "nrc/renderer/adaptation.h"
#include "shared/cache.h"
#include <filesystem>
#include <span>
#include <string>

namespace irradia {

struct NrcConfig {
    // Paths end where their area spread exceeds `spread` times the primary vertex' (Müller 2021,
    // section 3.4); infinity ("never") = not at all. Suffixes of training paths likewise.
    float spread = 0.01f;
    float trainingSpread = 0.01f;
    uint32_t endDepth = gpu::kNoDepth; // number of the vertex at which paths end at the latest
    // Of training paths whose suffix ends by Russian roulette alone; adaptation raises it. 0 = none.
    float unbiasedShare = 1.0f / 16.0f;
    uint32_t suffixBounces = 8; // of a training path, beyond those that --max-bounces gives a rendering path
    // Share of the paths that go on past their query, so that the picture is unbiased (the cache is then a
    // control variate); 0 = none.
    float residualShare = 0.0f;

    uint32_t recordsAt1080p = 65536; // wanted per frame of 1920 x 1080 pixels; scaled with the picture
    uint32_t minRecords = 4096;
    uint32_t steps = 4; // of optimisation a frame, when nothing is urgent
    // Share of the records that comes from points uniform over all surfaces instead of from the camera's
    // paths, so that what is out of sight is not forgotten: 0 = none, 0.05 is enough, 0.01 too little. The
    // scene needs its area table.
    float uniformShare = 0.0f;
    AdaptationConfig adaptation;
    bool factorise = true;               // predictions are multiplied by the reflectance
    Weights selfTraining = Weights::Ema; // whose predictions end training paths
    Weights shown = Weights::Ema;        // whose predictions are rendered
    bool showReflectance = true; // false: predictions are rendered without the reflectance, to be looked at
    ModelConfig model;

    bool operator==(const NrcConfig&) const = default;
};

// Throws Error: NotFound, or BadData naming the file and the key that is unknown, missing or out of range.
NrcConfig loadNrcConfig(const std::filesystem::path& file);
NrcConfig parseNrcConfig(const std::string& json, const std::string& name);
// With nothing inherited: parseNrcConfig gives it back, if not changed by a view.
std::string toJson(const NrcConfig& config);

// A model of its own, or with the preset's that its "base" names.
ModelConfig loadCacheModel(const std::filesystem::path& file);
ModelConfig parseCacheModel(const std::string& json, const std::string& name);

// The presets that come with the project. Throws Error(Usage) naming those there are.
NrcConfig nrcPreset(const std::string& name);
std::vector<std::string> nrcPresetNames();

} // namespace irradia
