// Reading a file as bytes, with the errors a user needs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace irradia {

// Throws Error: NotFound if nothing is there, Io if it is no regular file.
void requireFile(const std::filesystem::path& file);

std::vector<uint8_t> readFile(const std::filesystem::path& file);

} // namespace irradia
