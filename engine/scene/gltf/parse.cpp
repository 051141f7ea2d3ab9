#include "engine/scene/gltf/parse.h"

#include "engine/scene/gltf/data_uri.h"
#include "engine/scene/gltf/decompress.h"
#include "engine/scene/gltf/features.h"
#include "engine/scene/gltf/foreign.h"
#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/inspect.h"
#include "engine/scene/gltf/json_guard.h"
#include "engine/scene/gltf/plain_json.h"
#include <algorithm>
#include <exception>
#include <sstream>

namespace irradia::gltf {
namespace {

// Where the callbacks find the scene's folder, and leave an Error: tinygltf knows only success and failure.
struct FileAccess {
    const SourceFile& source;
    const JsonFindings& findings;
    std::exception_ptr error;

    // The buffer that tinygltf asks for: it takes "+" for a space, which is right in queries alone.
    const BufferClaim* find(const std::string& asked) const {
        for (const BufferClaim& buffer : findings.buffers) {
            std::string spaced = buffer.uri;
            std::ranges::replace(spaced, '+', ' ');
            if (decodeUri(spaced) == asked) return &buffer;
        }
        return nullptr;
    }

    std::string decoded(const std::string& asked) const {
        const BufferClaim* buffer = find(asked);
        return buffer ? decodeUri(buffer->uri) : asked;
    }
};

// tinygltf looks for a uri first as it stands, then in "."; the first look decides.
bool fileExists(const std::string& uri, void* user) {
    auto& access = *static_cast<FileAccess*>(user);
    if (access.error) return false;
    try {
        if (!isDataUri(uri)) resolveUri(access.source, access.decoded(uri));
        return true;
    } catch (...) {
        access.error = std::current_exception();
        return false;
    }
}

std::string sameName(const std::string& uri, void*) {
    return uri;
}

bool readWholeFile(std::vector<unsigned char>* out, std::string*, const std::string& uri, void* user) {
    auto& access = *static_cast<FileAccess*>(user);
    try {
        *out = readUri(access.source, access.decoded(uri));
        // A file may be longer than its buffer (glTF 2.0, 3.6.1.1); tinygltf wants the one length.
        if (const BufferClaim* buffer = access.find(uri); buffer && buffer->byteLength < out->size())
            out->resize(buffer->byteLength);
        return true;
    } catch (...) {
        access.error = std::current_exception();
        return false;
    }
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// Every callback, for tinygltf may take all of them or none. Versions from 2.9 on ask for a file's size
// before they read it, to compare it with a limit of their own; ours is checked in reading.
template <typename Callbacks = tinygltf::FsCallbacks>
Callbacks fileCallbacks(FileAccess& access) {
    Callbacks callbacks{};
    callbacks.FileExists = fileExists;
    callbacks.ExpandFilePath = sameName;
    callbacks.ReadWholeFile = readWholeFile;
    callbacks.WriteWholeFile = writeNothing;
    callbacks.user_data = &access;
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = [](size_t* size, std::string*, const std::string&, void*) {
            *size = 0;
            return true;
        };
    return callbacks;
}

// Keeps what a data URI held, of the media types that tinygltf knows. The bytes of a buffer view are
// unchecked here and are read later.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->as_is = true;
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

// tinygltf notes in `err` what it left out and goes on. Only two such notes are harmless: animations are not
// read here, and a skin without inverseBindMatrices is valid. Of the others the first is told.
void refuseOmissions(const SourceFile& source, const std::string& errors) {
    std::istringstream lines(errors);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && line != "." && line.find("inverseBindMatrices") == std::string::npos &&
            line.find("nimation") == std::string::npos && line.find("'node' property") == std::string::npos)
            source.refuse("{}", line);
}

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

} // namespace

JsonFindings readJson(const SourceFile& source) {
    refuseForeignFormat(source);
    JsonFindings findings = guardJson(source, jsonText(source));
    refuseUnreadableExtensions(source, findings);
    noteExtensions(source, findings);
    inspectTypes(source);
    return findings;
}

tinygltf::Model parseModel(const SourceFile& source, const JsonFindings& findings) {
    const std::vector<uint8_t> changed = plainBytes(source, findings);
    const std::vector<uint8_t>& bytes = changed.empty() ? source.bytes : changed;
    FileAccess access{source, findings, nullptr};
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks(fileCallbacks(access));
    reader.SetImageLoader(keepEncoded, nullptr);

    tinygltf::Model model;
    std::string errors, warnings;
    bool parsed = false;
    try {
        const auto size = static_cast<unsigned int>(bytes.size());
        const char* text = reinterpret_cast<const char*>(bytes.data());
        parsed = isBinary(source)
                     ? reader.LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(), size)
                     : reader.LoadASCIIFromString(&model, &errors, &warnings, text, size, "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) { // std::out_of_range, nlohmann's type errors
        source.refuse("{}", exception.what());
    }
    if (access.error) {
        source.attempt({{}, "/buffers"}, {}, [&] { std::rethrow_exception(access.error); });
        return {};
    }
    if (!parsed) source.refuse("{}", firstLine(errors));
    refuseOmissions(source, errors);
    if (!warnings.empty()) source.note(Severity::Warning, {}, {}, firstLine(warnings));
    if (model.asset.version.substr(0, 2) != "2.")
        source.refuse({{}, "/asset/version"}, "UNKNOWN_ASSET_MAJOR_VERSION", "glTF {}, only 2 can be read",
                      model.asset.version);
    restorePrimitives(model);
    decompress(source, model);
    return model;
}

} // namespace irradia::gltf
