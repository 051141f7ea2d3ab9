// What a saved model says of itself, a cache's or a trainer's alone.
#pragma once

#include "nrc/learning/model_file.h"
#include <string>
#include <utility>
#include <vector>

namespace irradia {

// A saved cache: its kind, and its blocks beside the trainer's.
inline constexpr const char* kCacheModel = "cache";
inline constexpr const char* kCacheStateBlock = "cache state";
inline constexpr const char* kCacheMeaningBlock = "meaning";

struct ModelFacts {
    std::string kind;
    uint32_t version = 0;
    std::string meaning;       // of the outputs, of a cache
    std::string shape;         // of network and encoding, in words
    std::string configuration; // JSON with tiny-cuda-nn's keys
    std::vector<std::pair<std::string, double>>
        counters; // "steps", "dropped_records", ..., those that it holds
    std::vector<ModelFile::BlockSize> blocks;
};

ModelFacts modelFacts(const ModelFile& model);

} // namespace irradia
