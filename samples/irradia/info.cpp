// irradia info: what a file is and what it holds, without rendering it.
#include "info.h"
#include "commands.h"
#include "engine/error.h"
#include "engine/image/read_file.h"
#include "engine/scene/gltf/foreign.h"
#include "engine/scene/gltf/glb.h"
#include "engine/scene/gltf/json_guard.h"
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using namespace std::string_view_literals;
using Print = void (*)(const std::filesystem::path& file, bool asJson);

// How the files begin that have a sheet.
struct Format {
    std::string_view start;
    Print print;
};
constexpr Format kFormats[] = {{"glTF"sv, printSceneInfo},
                               {"\x76\x2f\x31\x01"sv, printExrInfo},
                               {"#?"sv, printHdrInfo},
                               {"\x89PNG"sv, printScreenPictureInfo},
                               {"\xff\xd8\xff"sv, printScreenPictureInfo},
                               {"RIFF"sv, printScreenPictureInfo},
                               {"IRRADNET"sv, printModelInfo}};

// JSON that this program reads or writes and that is no scene, by a key of it.
struct JsonKind {
    const char* key;
    const char* name;
};
constexpr JsonKind kJsonKinds[] = {{"camera", "a camera file (render --camera)"},
                                   {"model", "a preset of the cache (render --preset)"},
                                   {"network", "a network's configuration (render --network)"},
                                   {"encoding", "a network's configuration (render --network)"},
                                   {"milliseconds", "the statistics of a render (render --stats)"},
                                   {"rays", "the results of a benchmark"},
                                   {"mlp", "the results of a benchmark"}};

constexpr size_t kHead = 4096; // bytes that tell what a file is

std::string headOf(const std::filesystem::path& file) {
    std::string head(kHead, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail(ExitCode::Io, "{}: cannot be opened for reading", file.string());
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<size_t>(stream.gcount()));
    return head;
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view name) {
    fail(ExitCode::BadData,
         "{}: this is {}: info knows scenes (.gltf, .glb), pictures (EXR, HDR, PNG, JPEG, WebP) and saved "
         "models",
         file.string(), name);
}

bool isText(std::string_view head) {
    return std::ranges::none_of(head, [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f';
    });
}

bool isJsonObject(std::string_view head) {
    if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3); // the mark of UTF-8
    const size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '{';
}

// A scene, unless its keys tell something else.
void requireSceneKeys(const std::filesystem::path& file) {
    const gltf::SourceFile source = gltf::openSource(file);
    const std::string_view text = gltf::jsonText(source);
    gltf::guardJson(source, text, gltf::Schema::Any);
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.contains("asset")) return;
    for (const JsonKind& kind : kJsonKinds)
        if (json.contains(kind.key)) refuse(file, kind.name);
    refuse(file, "JSON without the \"asset\" of a glTF scene");
}

Print choose(const std::filesystem::path& file) {
    requireFile(file);
    const std::string head = headOf(file);
    if (head.empty()) fail(ExitCode::BadData, "{}: the file is empty", file.string());
    for (const Format& format : kFormats)
        if (head.starts_with(format.start)) return format.print;
    if (const std::string_view name = gltf::foreignFormat(head); !name.empty()) refuse(file, name);
    if (!isJsonObject(head))
        refuse(file, isText(head) ? "text of no format known here" : "no format known here");
    requireSceneKeys(file);
    return printSceneInfo;
}

} // namespace

void addInfo(CLI::App& program) {
    struct Options {
        std::string file;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("info", "Show what a scene, a picture or a saved model holds");
    command->add_option("file", options->file, "glTF scene, EXR, HDR, PNG, JPEG, WebP, or a saved model")
        ->required()
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print one JSON object instead of a sheet");
    command->callback([options] { choose(options->file)(options->file, options->json); });
}

} // namespace irradia
