#include "engine/scene/gltf/foreign.h"

#include <algorithm>
#include <cctype>

namespace irradia::gltf {
namespace {

using namespace std::string_view_literals;

struct Format {
    std::string_view start;
    std::string_view name;
};

// Formats with a signature; of two that begin alike the longer start stands first.
constexpr Format kFormats[] = {
    {"\x1f\x8b"sv, "a gzip archive"},
    {"PK\x03\x04"sv, "a zip archive (or USDZ, 3MF)"},
    {"\x28\xb5\x2f\xfd"sv, "zstd-compressed"},
    {"BZh"sv, "bzip2-compressed"},
    {"\xfd"
     "7zXZ"sv,
     "xz-compressed"},
    {"7z\xbc\xaf"sv, "a 7z archive"},
    {"\xff\xfe\0\0"sv, "UTF-32 text"},
    {"\0\0\xfe\xff"sv, "UTF-32 text"},
    {"\xff\xfe"sv, "UTF-16 text; glTF is UTF-8"},
    {"\xfe\xff"sv, "UTF-16 text; glTF is UTF-8"},
    {"{\0"sv, "UTF-16 text; glTF is UTF-8"},
    {"\0{"sv, "UTF-16 text; glTF is UTF-8"},
    {"Kaydara FBX Binary"sv, "an FBX file"},
    {"; FBX"sv, "an FBX file"},
    {"#usda"sv, "a USD file"},
    {"PXR-USDC"sv, "a USD file"},
    {"BLENDER"sv, "a Blender file"},
    {"Ogawa"sv, "an Alembic file"},
    {"ply\n"sv, "a PLY file"},
    {"ply\r"sv, "a PLY file"},
    {"solid "sv, "an STL file"},
    {"b3dm"sv, "a 3D Tiles file"},
    {"DRACO"sv, "a Draco file"},
    {"\x89PNG"sv, "a PNG picture"},
    {"\xff\xd8\xff"sv, "a JPEG picture"},
    {"\x76\x2f\x31\x01"sv, "an OpenEXR picture"},
    {"#?RADIANCE"sv, "a Radiance HDR picture"},
    {"%PDF"sv, "a PDF file"},
    {"GIF8"sv, "a GIF picture"},
    {"II*\0"sv, "a TIFF picture"},
    {"MM\0*"sv, "a TIFF picture"},
    {"\xabKTX"sv, "a KTX texture"},
    {"DDS "sv, "a DDS texture"},
    {"\x7f"
     "ELF"sv,
     "a program"},
    {"IRRADNET"sv, "a saved model of this program"},
    {"version https://git-lfs"sv, "a pointer of Git LFS to a file that is not here"},
};

// Words that begin a line of a Wavefront OBJ.
constexpr std::string_view kObjWords[] = {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl", "newmtl"};

std::string_view firstWord(std::string_view line) {
    return line.substr(0, line.find_first_of(" \t"));
}

// By the first line that is neither blank nor a comment.
bool isObj(std::string_view text) {
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        return line.find_first_of(" \t") != std::string_view::npos &&
               std::ranges::find(kObjWords, firstWord(line)) != std::end(kObjWords);
    }
    return false;
}

bool contains(std::string_view text, std::string_view word) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(), [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           }) != text.end();
}

} // namespace

std::string_view foreignFormat(std::string_view bytes) {
    for (const Format& format : kFormats)
        if (bytes.starts_with(format.start)) return format.name;
    constexpr size_t kHead = 4096; // where a text says what it is
    const std::string_view head = bytes.substr(0, kHead);
    const size_t first = head.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && head[first] == '<') {
        if (contains(head, "<collada")) return "a COLLADA file";
        if (contains(head, "<x3d")) return "an X3D file";
        if (contains(head, "<html")) return "an HTML page";
        if (contains(head, "<scene")) return "an XML scene (Mitsuba's?)";
        return "an XML file";
    }
    return isObj(head) ? "a Wavefront OBJ or MTL file" : std::string_view();
}

void refuseForeignFormat(const SourceFile& source) {
    const std::string_view name =
        foreignFormat({reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size()});
    if (!name.empty()) source.refuse("this is {}: a glTF 2.0 scene is needed (.glb or .gltf)", name);
}

} // namespace irradia::gltf
