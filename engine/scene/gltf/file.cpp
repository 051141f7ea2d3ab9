#include "engine/scene/gltf/file.h"

#include "engine/image/read_file.h"
#include "engine/scene/gltf/data_uri.h"
#include <algorithm>
#include <charconv>

namespace irradia::gltf {
namespace {

std::vector<uint8_t> readCapped(const std::filesystem::path& file) {
    requireFile(file);
    const uint64_t size = std::filesystem::file_size(file);
    if (size > kMaxFileBytes)
        fail(ExitCode::BadData, "{}: {} bytes are more than the {} allowed", file.string(), size,
             kMaxFileBytes);
    if (size == 0) fail(ExitCode::BadData, "{}: the file is empty", file.string());
    return readFile(file);
}

bool isInside(const std::filesystem::path& folder, const std::filesystem::path& file) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && rest != file.end();
}

} // namespace

std::string printable(std::string text) {
    constexpr size_t kShown = 300;
    text = withoutData(std::move(text));
    if (text.size() > kShown) text = text.substr(0, kShown) + "...";
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

// A code may have a remark after it, "ACCESSOR_TOO_LONG (sparse indices)", which belongs to the sentence.
Finding SourceFile::found(Severity severity, const Thing& at, std::string_view code, const std::string& why) {
    const size_t end = std::min(code.find(' '), code.size());
    const std::string name(code.substr(0, end));
    std::string remark(code.substr(end));
    if (at.name.empty() && !remark.empty()) remark.erase(0, 1);
    const auto joined = [&](const std::string& head) {
        return printable(head.empty() ? why : fmt::format("{}: {}", head, why));
    };
    const std::string said = at.name == at.pointer ? "" : at.name; // the pointer stands beside it
    const std::string_view between = at.name.empty() || code.empty() ? "" : ": ";
    return {severity, name, at.pointer, joined(said + remark),
            joined(fmt::format("{}{}{}", at.name, between, code))};
}

Finding SourceFile::told(Severity severity, std::string_view pointer, std::string_view code,
                         const std::string& sentence) {
    const std::string text = printable(sentence);
    return {severity, std::string(code), std::string(pointer), text, text};
}

void SourceFile::refuseAs(Finding finding) const {
    const std::string sentence = fmt::format("{}: {}", path.string(), finding.message);
    throw Refusal(sentence, std::move(finding));
}

void SourceFile::keepOrThrow(const Error& error, const Thing& at, std::string_view code) const {
    const bool isOfFile = error.code() == ExitCode::BadData || error.code() == ExitCode::NotFound ||
                          error.code() == ExitCode::Io;
    if (!findings->collects() || !isOfFile) throw;
    if (const auto* refusal = dynamic_cast<const Refusal*>(&error)) {
        Finding finding = refusal->finding();
        if (finding.pointer.empty()) finding.pointer = at.pointer;
        if (finding.code.empty()) finding.code = code;
        return findings->keep(std::move(finding));
    }
    std::string sentence = error.what();
    if (const std::string head = path.string() + ": "; sentence.starts_with(head))
        sentence.erase(0, head.size());
    const bool isBroken = error.code() == ExitCode::BadData;
    findings->keep(told(Severity::Error, at.pointer, isBroken ? code : "IO_ERROR", sentence));
}

SourceFile openSource(const std::filesystem::path& file) {
    return {.path = file, .bytes = readCapped(file)};
}

std::string decodeUri(std::string_view uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned char code = 0;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(&uri[i + 1], &uri[i + 1] + 2, code, 16).ptr == &uri[i + 1] + 2) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

// Dot segments go by the text alone (RFC 3986, 5.2.4): folders between them need not be there.
std::filesystem::path relativePath(const SourceFile& source, std::string decodedUri) {
    std::error_code ignored;
    if (decodedUri.find('\\') != std::string::npos &&
        !std::filesystem::exists(source.path.parent_path() / decodedUri, ignored))
        std::ranges::replace(decodedUri, '\\', '/');
    return std::filesystem::path(decodedUri).lexically_normal();
}

std::filesystem::path resolveUri(const SourceFile& source, const std::string& decodedUri) {
    const std::filesystem::path relative = relativePath(source, decodedUri);
    const bool climbs = relative.begin() != relative.end() && *relative.begin() == "..";
    if (decodedUri.empty() || relative.is_absolute() || climbs || decodedUri.find(':') != std::string::npos ||
        decodedUri.find('\0') != std::string::npos)
        source.refuse("uri '{}' is not a plain path inside the scene's folder", decodedUri);

    std::error_code error;
    const auto folder = std::filesystem::weakly_canonical(source.path, error).parent_path();
    const auto file = std::filesystem::weakly_canonical(folder / relative, error);
    if (error || !isInside(folder, file))
        source.refuse("uri '{}' leads outside the scene's folder", decodedUri);
    return file;
}

std::vector<uint8_t> readUri(const SourceFile& source, const std::string& decodedUri) {
    if (!isDataUri(decodedUri)) return readCapped(resolveUri(source, decodedUri));
    if (auto bytes = decodeDataUri(decodedUri)) return std::move(*bytes);
    source.refuse("uri '{}' is not a usable data URI", decodedUri);
}

std::string label(std::string_view kind, size_t index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} {} '{}'", kind, index, name);
}

} // namespace irradia::gltf
