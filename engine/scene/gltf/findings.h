// The sink of what is found wrong with a file. Loading ends at the first error; validation collects.
#pragma once

#include "engine/error.h"
#include "engine/scene/finding.h"
#include <string>
#include <string_view>
#include <vector>

namespace irradia::gltf {

// A thing of the file: what messages call it, and where it stands in the JSON.
struct Thing {
    std::string name;    // "accessor 3 'bark'"
    std::string pointer; // "/accessors/3"

    // A member of it: of the same name, at "/accessors/3/count".
    Thing at(std::string_view member) const;
    Thing at(size_t element) const { return at(std::to_string(element)); }
    // A part that has a name of its own: "mesh 2 primitive 0".
    Thing called(std::string_view part) const { return {name + " " + std::string(part), pointer}; }
};

// "material 2 'wood'" at "/materials/2".
Thing thing(std::string_view kind, std::string_view array, size_t index, const std::string& name = {});

// An error that knows where in the file it is.
class Refusal : public Error {
public:
    Refusal(const std::string& sentence, Finding finding)
        : Error(ExitCode::BadData, sentence)
        , finding_(std::move(finding)) {}
    const Finding& finding() const { return finding_; }

private:
    Finding finding_;
};

class Findings {
public:
    enum class Mode { Load, Collect };

    explicit Findings(Mode mode = Mode::Load)
        : mode_(mode) {}

    bool collects() const { return mode_ == Mode::Collect; }

    // Adds it unless the same is there, or too many are: a broken file may earn one for each of a million
    // things.
    void keep(Finding finding);
    const std::vector<Finding>& all() const { return all_; }
    size_t errors() const { return errors_; }

private:
    Mode mode_;
    std::vector<Finding> all_;
    size_t errors_ = 0, others_ = 0;
};

} // namespace irradia::gltf
