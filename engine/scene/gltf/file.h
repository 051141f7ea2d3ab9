// A scene file on disk: its bytes, the name its errors carry, and what its URIs may reach (the file's own
// folder).
#pragma once

#include "engine/error.h"
#include "engine/scene/gltf/findings.h"
#include <cstdint>
#include <filesystem>
#include <memory>
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
    std::shared_ptr<Findings> findings = std::make_shared<Findings>();

    // Throws BadData with a sentence that begins with the file's path: "scene.glb: accessor 3: CODE: why".
    template <typename... Args>
    [[noreturn]] void refuse(const Thing& at, std::string_view code, fmt::format_string<Args...> why,
                             Args&&... args) const {
        refuseAs(found(Severity::Error, at, code, fmt::format(why, std::forward<Args>(args)...)));
    }
    // The same where there is no name for the fault, or for the thing.
    template <typename... Args>
    [[noreturn]] void refuse(fmt::format_string<Args...> sentence, Args&&... args) const {
        refuseAs(told(Severity::Error, {}, {}, fmt::format(sentence, std::forward<Args>(args)...)));
    }

    // An error after which the check can go on: thrown, or kept where findings are collected.
    template <typename... Args>
    void report(const Thing& at, std::string_view code, fmt::format_string<Args...> why,
                Args&&... args) const {
        Finding finding = found(Severity::Error, at, code, fmt::format(why, std::forward<Args>(args)...));
        if (!findings->collects()) refuseAs(std::move(finding));
        findings->keep(std::move(finding));
    }

    // What is mended or left out: "accessor 3: CODE: why".
    template <typename... Args>
    void warn(const Thing& at, std::string_view code, fmt::format_string<Args...> why, Args&&... args) const {
        findings->keep(found(Severity::Warning, at, code, fmt::format(why, std::forward<Args>(args)...)));
    }
    // A sentence that names the thing itself; the code is for reports.
    void note(Severity severity, std::string_view pointer, std::string_view code,
              const std::string& sentence) const {
        findings->keep(told(severity, pointer, code, sentence));
    }

    // Runs what reads or checks one thing. Where findings are collected, an error is kept and false returned;
    // one without a place and a code of its own gets these.
    template <typename Check>
    bool attempt(const Thing& at, std::string_view code, Check&& check) const {
        try {
            check();
            return true;
        } catch (const Error& error) {
            keepOrThrow(error, at, code);
            return false;
        }
    }

    static Finding found(Severity severity, const Thing& at, std::string_view code, const std::string& why);
    static Finding told(Severity severity, std::string_view pointer, std::string_view code,
                        const std::string& sentence);
    [[noreturn]] void refuseAs(Finding finding) const;

private:
    void keepOrThrow(const Error& error, const Thing& at, std::string_view code) const;
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
