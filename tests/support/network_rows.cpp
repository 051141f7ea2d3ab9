#include "tests/support/network_rows.h"

#include "shared/network.h"
#include "tests/reference/half.h"
#include <cstring>

namespace irradia::test {

namespace {

// Index of a row's value among all values of the buffer.
size_t valueIndex(const RowFormat& format, uint32_t row, uint32_t value) {
    return size_t{gpu::quadIndex(row, value / 4, format.quads())} * 4 + value % 4;
}

void put(std::byte* to, double value, Precision precision) {
    if (precision == Precision::Half) {
        const uint16_t bits = reference::halfBits(value);
        std::memcpy(to, &bits, sizeof bits);
    } else {
        const auto single = static_cast<float>(value);
        std::memcpy(to, &single, sizeof single);
    }
}

double get(const std::byte* from, Precision precision) {
    if (precision == Precision::Half) {
        uint16_t bits = 0;
        std::memcpy(&bits, from, sizeof bits);
        return reference::halfFromBits(bits);
    }
    float single = 0.0f;
    std::memcpy(&single, from, sizeof single);
    return single;
}

} // namespace

double stored(double value, Precision precision) {
    return precision == Precision::Half ? reference::roundToHalf(value) : static_cast<float>(value);
}

Buffer rowBuffer(const RowFormat& format, uint32_t capacity, const std::vector<double>& rows, double filling,
                 Device& device) {
    std::vector<std::byte> bytes(format.bytes(capacity));
    for (size_t i = 0; i < bytes.size() / format.valueBytes(); ++i)
        put(&bytes[i * format.valueBytes()], filling, format.precision);
    for (size_t i = 0; i < rows.size(); ++i) {
        const auto row = static_cast<uint32_t>(i / format.width),
                   value = static_cast<uint32_t>(i % format.width);
        put(&bytes[valueIndex(format, row, value) * format.valueBytes()], rows[i], format.precision);
    }
    return makeBuffer(device, "rows", bytes);
}

std::vector<double> downloadRows(const Buffer& buffer, const RowFormat& format, uint32_t count,
                                 Device& device) {
    const auto bytes = download<std::byte>(device, buffer, buffer.bytes());
    std::vector<double> rows;
    for (uint32_t row = 0; row < count; ++row)
        for (uint32_t value = 0; value < format.width; ++value)
            rows.push_back(
                get(&bytes[valueIndex(format, row, value) * format.valueBytes()], format.precision));
    return rows;
}

} // namespace irradia::test
