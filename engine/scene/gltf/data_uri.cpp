#include "engine/scene/gltf/data_uri.h"

#include <algorithm>
#include <cctype>

namespace irradia::gltf {
namespace {

constexpr std::string_view kScheme = "data:";
constexpr std::string_view kBase64 = ";base64";
constexpr std::string_view kEnds = "'\",\n"; // of a URI in a message

bool sameLetters(char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool equals(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), sameLetters);
}

// Base64's value of a character (RFC 4648, 4 and 5), or -1.
int sixBits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-' || c == ' ') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::vector<uint8_t>> decodeBase64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        if (c == '\n' || c == '\r' || c == '\t') continue;
        const int value = sixBits(c);
        if (value < 0) return std::nullopt;
        bits = bits << 6 | static_cast<uint32_t>(value);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<uint8_t>(bits >> held));
    }
    return bytes;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return uri.size() >= kScheme.size() && equals(uri.substr(0, kScheme.size()), kScheme);
}

std::optional<std::vector<uint8_t>> decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    if (head.size() >= kBase64.size() && equals(head.substr(head.size() - kBase64.size()), kBase64))
        return decodeBase64(data);
    return std::vector<uint8_t>(data.begin(), data.end());
}

std::string withoutData(std::string text) {
    for (auto at = text.begin();;) {
        at = std::search(at, text.end(), kScheme.begin(), kScheme.end(), sameLetters);
        if (at == text.end()) return text;
        const auto comma = std::find(at, text.end(), ',');
        if (comma == text.end()) return text;
        const auto end = std::find_if(comma + 1, text.end(),
                                      [](char c) { return kEnds.find(c) != std::string_view::npos; });
        const auto kept = comma - text.begin() + 1;
        text.replace(comma + 1, end, "...");
        at = text.begin() + kept;
    }
}

} // namespace irradia::gltf
