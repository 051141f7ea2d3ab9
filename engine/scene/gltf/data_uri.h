// Data inside a URI (RFC 2397), of any media type: exporters name many for one and the same thing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace irradia::gltf {

// "data:" in upper or lower case.
bool isDataUri(std::string_view uri);

// The bytes of a data URI, as base64 or as text whose "%20" and its like are already decoded. Nothing where
// the comma is missing or the base64 holds what is none. A space counts as "+", which tinygltf turns into it.
std::optional<std::vector<uint8_t>> decodeDataUri(std::string_view uri);

// The text with the data of data URIs left out, as messages show it.
std::string withoutData(std::string text);

} // namespace irradia::gltf
