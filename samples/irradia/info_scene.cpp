// irradia info of a glTF scene.
#include "engine/scene/scene_facts.h"
#include "info.h"
#include "samples/support/sheet.h"
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

namespace irradia {
namespace {

using nlohmann::ordered_json;

std::string counted(uint64_t count, const std::string& what, const std::string& plural = "") {
    return fmt::format("{} {}", count, count == 1 ? what : plural.empty() ? what + "s" : plural);
}

std::string describe(const glm::dvec3& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

std::string describe(const Camera& camera, size_t index) {
    const std::string name = camera.name.empty() ? fmt::format("{}", index) : "'" + camera.name + "'";
    if (camera.isOrthographic())
        return fmt::format("{}, orthographic, {:.4g} high", name, 2 * camera.halfHeight);
    return fmt::format("{}, {:.4g} degrees", name, glm::degrees(camera.verticalFov));
}

std::string triangles(const SceneFacts& facts) {
    std::string text = fmt::format("{}", facts.triangles);
    if (facts.degenerateTriangles > 0)
        text += fmt::format(", {} without area left out", facts.degenerateTriangles);
    if (facts.nonFiniteTriangles > 0)
        text += fmt::format(", {} that are not finite left out", facts.nonFiniteTriangles);
    return text;
}

std::string describe(const ExtensionFact& extension) {
    std::string text = fmt::format("{}: {}", extension.name, extension.support);
    if (!extension.consequence.empty()) text += ", " + extension.consequence;
    return extension.isRequired ? text + " (required)" : text;
}

std::vector<std::string> lights(const SceneFacts& facts) {
    std::vector<std::string> lines;
    lines.push_back(facts.emissiveTriangles == 0
                        ? "no emissive triangle"
                        : fmt::format("{} of {}", counted(facts.emissiveTriangles, "emissive triangle"),
                                      counted(facts.emissiveMaterials, "material")));
    lines.push_back("no environment: --env or a camera file gives one");
    const auto add = [&](uint64_t count, const std::string& what) {
        if (count > 0) lines.push_back(counted(count, what));
    };
    add(facts.pointLights, "point light");
    add(facts.spotLights, "spot light");
    add(facts.directionalLights, "directional light");
    if (facts.extensionLights > 0)
        lines.push_back(fmt::format("{} of extensions, ignored", counted(facts.extensionLights, "light")));
    return lines;
}

// "5, of them 1 masked, 2 blended"
std::string materials(const SceneFacts& facts) {
    std::vector<std::string> kinds;
    const auto add = [&](uint64_t count, const char* what) {
        if (count > 0) kinds.push_back(fmt::format("{} {}", count, what));
    };
    add(facts.maskedMaterials, "masked");
    add(facts.blendedMaterials, "blended");
    add(facts.transmissiveMaterials, "transmissive");
    add(facts.unlitMaterials, "unlit");
    std::string text = fmt::format("{}", facts.materials);
    return kinds.empty() ? text : fmt::format("{}, of them {}", text, fmt::join(kinds, ", "));
}

std::vector<std::string> notRendered(const SceneFacts& facts) {
    std::vector<std::string> lines;
    if (facts.animations > 0) lines.push_back(counted(facts.animations, "animation"));
    if (facts.skins > 0) lines.push_back(counted(facts.skins, "skin"));
    if (facts.morphTargets > 0) lines.push_back(counted(facts.morphTargets, "morph target"));
    return lines;
}

// Those without a name together by their size.
std::vector<std::string> pictures(const SceneFacts& facts) {
    std::vector<std::string> lines;
    std::map<std::string, uint64_t> unnamed;
    for (const PictureFact& picture : facts.usedPictures) {
        const std::string size = fmt::format("{} x {}", picture.width, picture.height);
        if (picture.name.empty())
            ++unnamed[size];
        else
            lines.push_back(fmt::format("{}  {}", size, picture.name));
    }
    for (const auto& [size, count] : unnamed)
        lines.push_back(count == 1 ? size : fmt::format("{}, {} of them", size, count));
    return lines;
}

void printSheet(const std::filesystem::path& file, const SceneFacts& facts) {
    Sheet sheet;
    sheet.add("file", file.string());
    sheet.add("kind", fmt::format("glTF {} scene ({}), {} bytes", facts.version, facts.format, facts.bytes));
    if (!facts.generator.empty()) sheet.add("made by", facts.generator);
    sheet.add("triangles", triangles(facts));
    sheet.add("vertices", fmt::format("{}", facts.vertices));
    sheet.add("meshes",
              fmt::format("{}, {}, placed by {}", facts.meshes, counted(facts.primitives, "primitive"),
                          counted(facts.instances, "node")));
    sheet.add("materials", materials(facts));
    if (facts.colouredPrimitives > 0)
        sheet.add("vertex colours", fmt::format("of {}", counted(facts.colouredPrimitives, "primitive")));
    if (facts.textures + facts.pictures > 0)
        sheet.add("textures", fmt::format("{}, {}, of which {} used with {}", facts.textures,
                                          counted(facts.pictures, "picture"), facts.usedPictures.size(),
                                          counted(facts.texels, "texel")));
    else
        sheet.add("textures", "none");
    sheet.add("pictures", pictures(facts));
    sheet.add("lights", lights(facts));
    std::vector<std::string> cameras, extensions;
    for (size_t i = 0; i < facts.cameras.size(); ++i) cameras.push_back(describe(facts.cameras[i], i));
    if (cameras.empty()) cameras.push_back("none: the view frames the whole scene");
    sheet.add("cameras", cameras);
    if (facts.triangles > 0)
        sheet.add("bounds", {"from " + describe(facts.lower), "to   " + describe(facts.upper)});
    for (const ExtensionFact& extension : facts.extensions) extensions.push_back(describe(extension));
    sheet.add("extensions", extensions);
    sheet.add("not rendered", notRendered(facts));
    sheet.add("warnings", facts.warnings);
    sheet.print();
}

ordered_json toJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json toJson(const Camera& camera) {
    ordered_json json{{"name", camera.name},
                      {"type", camera.isOrthographic() ? "orthographic" : "perspective"}};
    if (camera.isOrthographic())
        json["height"] = 2 * camera.halfHeight;
    else
        json["vfov_deg"] = glm::degrees(camera.verticalFov);
    return json;
}

ordered_json listsOf(const SceneFacts& facts) {
    auto pictures = ordered_json::array(), cameras = pictures, extensions = pictures;
    for (const PictureFact& picture : facts.usedPictures)
        pictures.push_back({{"name", picture.name}, {"width", picture.width}, {"height", picture.height}});
    for (const Camera& camera : facts.cameras) cameras.push_back(toJson(camera));
    for (const ExtensionFact& extension : facts.extensions)
        extensions.push_back({{"name", extension.name},
                              {"support", extension.support},
                              {"required", extension.isRequired},
                              {"consequence", extension.consequence}});
    return {{"pictures", pictures}, {"cameras", cameras}, {"extensions", extensions}};
}

ordered_json toJson(const std::filesystem::path& file, const SceneFacts& facts) {
    ordered_json json{
        {"file", file.string()},
        {"kind", "scene"},
        {"format", facts.format},
        {"version", facts.version},
        {"generator", facts.generator},
        {"bytes", facts.bytes},
        {"triangles", facts.triangles},
        {"degenerate_triangles", facts.degenerateTriangles},
        {"nonfinite_triangles", facts.nonFiniteTriangles},
        {"vertices", facts.vertices},
        {"meshes", facts.meshes},
        {"primitives", facts.primitives},
        {"instances", facts.instances},
        {"nodes", facts.nodes},
        {"scenes", facts.scenes},
        {"materials", facts.materials},
        {"masked_materials", facts.maskedMaterials},
        {"blended_materials", facts.blendedMaterials},
        {"transmissive_materials", facts.transmissiveMaterials},
        {"unlit_materials", facts.unlitMaterials},
        {"coloured_primitives", facts.colouredPrimitives},
        {"textures", facts.textures},
        {"pictures_in_file", facts.pictures},
        {"texels", facts.texels},
        {"lights",
         {{"emissive_triangles", facts.emissiveTriangles},
          {"emissive_materials", facts.emissiveMaterials},
          {"environment", false}, // glTF itself has none
          {"point", facts.pointLights},
          {"spot", facts.spotLights},
          {"directional", facts.directionalLights},
          {"ignored", facts.extensionLights}}},
        {"bounds", {{"lower", toJson(facts.lower)}, {"upper", toJson(facts.upper)}}},
        {"not_rendered",
         {{"animations", facts.animations}, {"skins", facts.skins}, {"morph_targets", facts.morphTargets}}}};
    json.update(listsOf(facts));
    json["warnings"] = facts.warnings;
    return json;
}

} // namespace

void printSceneInfo(const std::filesystem::path& file, bool asJson) {
    const SceneFacts facts = readSceneFacts(file);
    if (asJson)
        printJson(toJson(file, facts));
    else
        printSheet(file, facts);
}

} // namespace irradia
