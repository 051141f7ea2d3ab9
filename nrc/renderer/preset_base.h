// Inheritance by name: a preset says {"base": "balanced", ...} and has every key that it does not give itself
// from there, a model from there the preset's "model". Objects are merged; an object of another "otype" than
// the base's, lists and all else replace what the base has.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace irradia {

// A preset that comes with the project, without "base". Throws Error(Usage) naming those there are.
nlohmann::json nrcPresetJson(const std::string& name);

// `own`, read from `file`, with what it inherits. Throws Error(BadData) where its base is none.
nlohmann::json presetWithBase(nlohmann::json own, const std::string& file);
nlohmann::json modelWithBase(nlohmann::json own, const std::string& file);

} // namespace irradia
