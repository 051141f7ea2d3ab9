#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradia::reference {

// Whether each of 0 .. n - 1 stands in the list of n exactly once.
inline bool isPermutation(const std::vector<uint32_t>& list) {
    std::vector<bool> seen(list.size(), false);
    for (const uint32_t i : list) {
        if (i >= list.size() || seen[i]) return false;
        seen[i] = true;
    }
    return true;
}

} // namespace irradia::reference
