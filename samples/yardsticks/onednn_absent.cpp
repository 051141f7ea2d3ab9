// In place of onednn_mlp.cpp where the build found no oneDNN.
#include "samples/yardsticks/mlp_yardstick.h"

namespace irradia {

std::unique_ptr<MlpYardstick> makeOnednnMlp(const MlpProblem&, uint32_t) {
    return nullptr;
}

} // namespace irradia
