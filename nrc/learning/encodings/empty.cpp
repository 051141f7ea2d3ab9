// Its inputs are left out: a model sees no more than a scene needs.
#include "nrc/learning/encodings/kind.h"

namespace irradia {

EncodingKind empty() {
    return {.otype = "Empty"};
}

} // namespace irradia
