// What an encoding is. All that is known of one stands in a file of this folder, as an EncodingKind that a
// line of table.cpp lists, and in its kernel.
#pragma once

#include "nrc/learning/encoding_layout.h"
#include "nrc/learning/encodings/slice.h"
#include "nrc/learning/json_fields.h"
#include <functional>

namespace irradia {

// A key that an encoding takes beside "otype" and "n_dims_to_encode".
struct EncodingKey {
    std::string name;
    double standard = 0; // where makeEncoding is given none
    std::function<double(JsonFields&)> read;
    std::function<nlohmann::ordered_json(double)> write;
};

// Keys that must be given: whole numbers in a range or a list, numbers.
EncodingKey wholeKey(const char* name, uint32_t low, uint32_t high, uint32_t standard);
EncodingKey wholeKey(const char* name, std::initializer_list<uint32_t> allowed, uint32_t standard);
EncodingKey numberKey(const char* name, NumberRange range, double standard);
// Keys that may be left out, which means `standard`, or the first of the names. A choice's value is the place
// of its name.
EncodingKey optionalNumberKey(const char* name, NumberRange range, double standard);
EncodingKey choiceKey(const char* name, std::vector<const char*> names);

struct EncodingKind {
    std::string otype;
    std::vector<EncodingKey> keys; // in the order in which they are written
    // Refuses keys that do not go together.
    void (*checkKeys)(const JsonFields&, const EncodingConfig&) = nullptr;

    // Values of a row from config.dims inputs. None = what it takes is left out.
    uint32_t (*values)(const EncodingConfig&) = nullptr;
    // Each input gives values of its own, all in the same way: alike neighbours are encoded together, and
    // those of many inputs in several slices.
    bool treatsInputsAlike = false;
    // Why it cannot encode config.dims inputs with these keys; empty if it can.
    std::string (*misfit)(const EncodingConfig&) = nullptr;

    // Of an encoding without features: its kernel in single and half precision, which includes
    // shaders/learning/encode.glsl and binds the encoded rows at 2, and the kernel's own constants
    // (gpu::kConstantOwn).
    const KernelSource* kernel = nullptr;
    const KernelSource* halfKernel = nullptr;
    std::vector<uint32_t> (*constants)(const EncodingConfig&) = nullptr;

    // Of an encoding with features that are learned: those of a slice.
    std::unique_ptr<SliceFeatures> (*features)(const EncodingConfig&, const FeatureRoom&) = nullptr;
};

// A constant's value as the kernel is given it.
uint32_t floatBits(double value);

} // namespace irradia
