// The names that a model's JSON has for our enumerations.
#pragma once

#include "nrc/learning/config.h"
#include "nrc/learning/json_fields.h"

namespace irradia {

constexpr EnumName<OutputActivation> kOutputActivationNames[] = {
    {OutputActivation::None, "None"},
    {OutputActivation::ReLU, "ReLU"},
    {OutputActivation::Exponential, "Exponential"},
    {OutputActivation::Softplus, "Softplus"},
};

constexpr EnumName<Precision> kPrecisionNames[] = {{Precision::Float, "Float"}, {Precision::Half, "Half"}};

constexpr EnumName<NetworkForm> kFormNames[] = {
    {NetworkForm::Auto, "Auto"},
    {NetworkForm::Subgroup, "Subgroup"},
    {NetworkForm::Workgroup, "Workgroup"},
};

constexpr EnumName<LossType> kLossNames[] = {
    {LossType::L2, "L2"},
    {LossType::RelativeL2, "RelativeL2"},
    {LossType::RelativeL2Luminance, "RelativeL2Luminance"},
};

enum class OptimizerType { Adam, Ema, ExponentialDecay };
constexpr EnumName<OptimizerType> kOptimizerNames[] = {
    {OptimizerType::Adam, "Adam"},
    {OptimizerType::Ema, "Ema"},
    {OptimizerType::ExponentialDecay, "ExponentialDecay"},
};

} // namespace irradia
