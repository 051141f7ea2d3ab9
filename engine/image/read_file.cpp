#include "engine/image/read_file.h"

#include "engine/error.h"
#include <fstream>

namespace irradia {

void requireFile(const std::filesystem::path& file) {
    std::error_code error;
    const auto type = std::filesystem::status(file, error).type();
    if (type == std::filesystem::file_type::not_found)
        fail(ExitCode::NotFound, "{}: no such file", file.string());
    if (type != std::filesystem::file_type::regular)
        fail(ExitCode::Io, "{}: {}", file.string(), error ? error.message() : "not a regular file");
}

std::vector<uint8_t> readFile(const std::filesystem::path& file) {
    requireFile(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(ExitCode::Io, "{}: cannot be opened for reading", file.string());
    std::vector<uint8_t> bytes(std::filesystem::file_size(file));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<size_t>(stream.gcount()) != bytes.size())
        fail(ExitCode::Io, "{}: reading stopped after {} of {} bytes", file.string(), stream.gcount(),
             bytes.size());
    return bytes;
}

} // namespace irradia
