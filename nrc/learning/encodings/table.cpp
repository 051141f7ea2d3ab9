#include "nrc/learning/encodings/table.h"

#include "engine/error.h"
#include <algorithm>

namespace irradia {

// Each in the file of its name, or of its family: frequency.cpp, grid.cpp.
EncodingKind empty(), identity(), frequency(), triangleWave(), oneBlob(), sphericalHarmonics(), denseGrid(),
    sparseGrid(), hashGrid();

std::deque<EncodingKind>& encodingKinds() {
    static std::deque<EncodingKind> kinds{
        empty(),     identity(),   frequency(), triangleWave(), oneBlob(), sphericalHarmonics(),
        denseGrid(), sparseGrid(), hashGrid(),
    };
    return kinds;
}

const EncodingKind& encodingKind(const std::string& otype) {
    const auto found = std::ranges::find(encodingKinds(), otype, &EncodingKind::otype);
    if (found == encodingKinds().end()) fail(ExitCode::Internal, "encoding: there is no '{}'", otype);
    return *found;
}

std::vector<const char*> encodingNames() {
    std::vector<const char*> names;
    for (const EncodingKind& kind : encodingKinds()) names.push_back(kind.otype.c_str());
    return names;
}

} // namespace irradia
