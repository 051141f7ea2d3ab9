// A scene file on disk: its bytes, the name its errors carry, and what its URIs may reach (the file's own
// folder).
#pragma once

#include "engine/error.h"
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace irradia::gltf {

// Above this a file, a buffer and an offset would leave the 31 bits tinygltf counts in.
constexpr uint64_t kMaxFileBytes = (uint64_t{1} << 31) - 1;

// Text from a file as a terminal may show it: no control characters, no base64, no more than fits a few
// lines.
std::string printable(std::string text);

struct SourceFile {
    std::filesystem::path path;
    std::vector<uint8_t> bytes;

    // Throws BadData with a sentence that begins with the file's path.
    template <typename... Args>
    [[noreturn]] void refuse(fmt::format_string<Args...> sentence, Args&&... args) const {
        fail(ExitCode::BadData, "{}: {}", path.string(),
             printable(fmt::format(sentence, std::forward<Args>(args)...)));
    }
};

// Throws Error: NotFound, Io, or BadData for an empty file or one above kMaxFileBytes.
SourceFile openSource(const std::filesystem::path& file);

// "%20" and its like as the bytes they stand for.
std::string decodeUri(std::string_view uri);

// A decoded relative URI as a path from the scene's folder, unchecked. Backslashes, as programs of Windows
// write them, stand between folders where no file has them in its name.
std::filesystem::path relativePath(const SourceFile& source, std::string decodedUri);

// The file a decoded relative URI names. Throws BadData for anything that leaves the scene's folder: an
// absolute path, a scheme, ".." beyond it, a symbolic link to elsewhere.
std::filesystem::path resolveUri(const SourceFile& source, const std::string& decodedUri);

// The bytes of a file beside the scene, or of a data URI. Throws as openSource and resolveUri.
std::vector<uint8_t> readUri(const SourceFile& source, const std::string& decodedUri);

// "accessor 3" or "material 2 'wood'".
std::string label(std::string_view kind, size_t index, const std::string& name = {});

} // namespace irradia::gltf
