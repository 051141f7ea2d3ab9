#include "engine/image/picture_file.h"

#include "engine/error.h"
#include <algorithm>
#include <cctype>

namespace irradia {
namespace {

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

} // namespace

std::string PictureName::extension() const {
    return lowerCase(file.extension().string());
}

PictureName parsePictureName(const std::string& text) {
    std::error_code ignored;
    if (std::filesystem::exists(text, ignored)) return {text, ""};
    const std::string lower = lowerCase(text);
    const size_t colon = std::max(lower.rfind(".exr:") + 1, lower.rfind(".hdr:") + 1); // npos + 1 = 0
    if (colon == 0) return {text, ""};
    constexpr size_t kEnding = 3; // "exr"
    return {text.substr(0, colon + kEnding), text.substr(colon + kEnding + 1)};
}

LayeredImage readPicture(const PictureName& name) {
    if (name.extension() != ".hdr") return readExr(name.file, name.layer);
    if (!name.layer.empty())
        fail(ExitCode::BadData, "{}: an HDR picture has no layer '{}'", name.file.string(), name.layer);
    return readHdr(name.file);
}

} // namespace irradia
