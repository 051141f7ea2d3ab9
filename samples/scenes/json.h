// JSON as the scenes write it: floats of 32 bits print in as few digits as they need; keys keep their order.
#pragma once

#include <nlohmann/json.hpp>

namespace irradia::scenes {

using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t,
                                  std::uint64_t, float>;

} // namespace irradia::scenes
