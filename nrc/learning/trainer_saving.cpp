// What a trainer has learned, on disk and as numbers.
#include "engine/error.h"
#include "nrc/learning/trainer_state.h"
#include <array>
#include <fmt/format.h>

namespace irradia {
namespace {

// Values, moments and averages of all groups, each as one block.
constexpr std::array<const char*, 4> kLearnedBlocks{"parameters", "first moments", "second moments",
                                                    "averages"};

} // namespace

std::string Trainer::shapeName() const {
    const ModelConfig& model = state_->config;
    std::string name =
        fmt::format("{} with {} inputs, {} outputs, output activation {}, encoding {}",
                    describe(model.network), state_->encoding.inputs(), state_->network.outputs(),
                    describe(model.network.outputActivation), describe(model.encoding));
    if (const auto corners = state_->encoding.storedCorners())
        name += fmt::format(" at corners {:08x}", *corners);
    return name;
}

void Trainer::save(const std::filesystem::path& file, ModelFile model) const {
    model.addText("shape", shapeName());
    model.addText("configuration", toJson(state_->config));
    model.add<gpu::TrainingState>("counters", download<gpu::TrainingState>(state_->device, state_->state, 1));
    for (size_t i = 0; i < kLearnedBlocks.size(); ++i) {
        std::vector<float> content;
        for (const ParameterGroup* group : state_->groups()) {
            const auto values = download<float>(state_->device, *group->learned()[i], group->count);
            content.insert(content.end(), values.begin(), values.end());
        }
        model.add<float>(kLearnedBlocks[i], content);
    }
    model.write(file);
}

void Trainer::load(const std::filesystem::path& file) {
    load(ModelFile::read(file, kNetworkModel));
}

void Trainer::load(const ModelFile& model) {
    if (const std::string shape = model.text("shape"); shape != shapeName())
        model.refuse(fmt::format("holds a model of {}, wanted is one of {}", shape, shapeName()));
    const auto counters = model.values<gpu::TrainingState>("counters", 1);
    std::vector<std::vector<float>> learned; // nothing is changed before all is there
    for (const char* name : kLearnedBlocks) learned.push_back(model.values<float>(name, parameterCount()));
    for (size_t i = 0; i < learned.size(); ++i) {
        std::span<const float> rest = learned[i];
        for (const ParameterGroup* group : state_->groups()) {
            upload<float>(state_->device, *group->learned()[i], rest.first(group->count));
            rest = rest.subspan(group->count);
        }
    }
    upload<gpu::TrainingState>(state_->device, state_->state, counters);
    state_->inferPackedHolds.forget();
}

std::vector<float> Trainer::parameters(Weights which) const {
    std::vector<float> all;
    for (const ParameterGroup* group : state_->groups()) {
        const Buffer& from = which == Weights::Ema ? group->averages : group->values;
        const auto values = download<float>(state_->device, from, group->count);
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

void Trainer::setParameters(std::span<const float> values) {
    if (values.size() != parameterCount())
        fail(ExitCode::Internal, "trainer: {} parameters to set, not {}", values.size(), parameterCount());
    for (const ParameterGroup* group : state_->groups()) {
        upload<float>(state_->device, group->values, values.first(group->count));
        values = values.subspan(group->count);
    }
    state_->inferPackedHolds.forget();
}

} // namespace irradia
