#include "nrc/cache/model_facts.h"

#include "shared/cache.h"
#include "shared/training.h"
#include <algorithm>
#include <optional>

namespace irradia {
namespace {

// Other kinds may have blocks of these names that hold something else.
template <typename T>
std::optional<T> only(const ModelFile& model, const std::string& name) {
    const auto isIt = [&](const ModelFile::BlockSize& block) {
        return block.name == name && block.bytes == sizeof(T);
    };
    if (std::ranges::none_of(model.blocks(), isIt)) return std::nullopt;
    return model.values<T>(name, 1).front();
}

std::string textIn(const ModelFile& model, const char* name) {
    return model.has(name) ? model.text(name) : "";
}

} // namespace

ModelFacts modelFacts(const ModelFile& model) {
    ModelFacts facts;
    facts.kind = model.kind();
    facts.version = ModelFile::version();
    facts.meaning = textIn(model, kCacheMeaningBlock);
    facts.shape = textIn(model, "shape");
    facts.configuration = textIn(model, "configuration");
    facts.blocks = model.blocks();
    if (const auto state = only<gpu::TrainingState>(model, "counters"))
        facts.counters = {{"steps", state->steps},
                          {"dropped_records", state->droppedRecords},
                          {"clipped_steps", state->clippedSteps},
                          {"damaged_parameters", state->damagedParameters},
                          {"loss", double{state->loss}}};
    if (const auto state = only<gpu::CacheState>(model, kCacheStateBlock)) {
        facts.counters.emplace_back("frames", state->frames);
        facts.counters.emplace_back("scale", double{state->scale});
        facts.counters.emplace_back("brightness", double{state->brightness});
    }
    return facts;
}

} // namespace irradia
