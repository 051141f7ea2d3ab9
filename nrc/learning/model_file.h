// A trained model on disk: what it is in words, how it was configured (JSON), where training stands, and its
// numbers.
//
//     "IRRADNET", version, then lengths and bytes of shape and configuration (UTF-8), gpu::TrainingState, the
//     number of floats and the floats, and the CRC-32 of all that precedes it; integers and floats
//     little-endian.
#pragma once

#include "shared/training.h"
#include <filesystem>
#include <string>
#include <vector>

namespace irradia {

struct ModelFile {
    std::string shape;  // Trainer::shapeName
    std::string config; // toJson(ModelConfig)
    gpu::TrainingState state{};
    std::vector<float> content;
};

// Written whole or not at all. Throws Error(Io).
void writeModel(const std::filesystem::path& file, const ModelFile& model);

// Throws Error: NotFound, or BadData naming the file and what differs: no model, another version, cut off or
// changed, or of another shape or size than asked for.
ModelFile readModel(const std::filesystem::path& file, const std::string& shape, uint64_t contentCount);

} // namespace irradia
