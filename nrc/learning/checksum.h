// CRC-32 of what models hold or depend on.
#pragma once

#include <cstdint>
#include <span>
#include <zlib.h>

namespace irradia {

// `before`: of what precedes these values; 0 = nothing.
template <typename T>
uint32_t checksum(std::span<const T> values, uint32_t before = 0) {
    return static_cast<uint32_t>(
        crc32_z(before, reinterpret_cast<const Bytef*>(values.data()), values.size_bytes()));
}

} // namespace irradia
