#include "engine/scene/scene_facts.h"

#include "engine/scene/gltf/assemble.h"
#include "engine/scene/gltf/features.h"
#include "engine/scene/gltf/nodes.h"
#include "engine/scene/gltf/parse.h"
#include "engine/scene/gltf/validate.h"
#include "engine/scene/gltf/values.h"
#include <algorithm>
#include <new>

namespace irradia {
namespace {

const char* nameOf(gltf::Support support) {
    switch (support) {
    case gltf::Support::Read:
        return "rendered";
    case gltf::Support::Ignored:
        return "ignored";
    default:
        return "unknown";
    }
}

uint64_t countImageLights(const tinygltf::Model& model) {
    const auto* extension = gltf::findExtension(model.extensions, "EXT_lights_image_based");
    return extension ? gltf::member(*extension, "lights").ArrayLen() : 0;
}

void countModel(const tinygltf::Model& model, SceneFacts& facts) {
    facts.version = model.asset.version;
    facts.generator = gltf::printable(model.asset.generator);
    facts.meshes = model.meshes.size();
    facts.nodes = model.nodes.size();
    facts.scenes = model.scenes.size();
    facts.materials = model.materials.size();
    facts.textures = model.textures.size();
    facts.pictures = model.images.size();
    facts.extensionLights = countImageLights(model);
    facts.animations = model.animations.size();
    facts.skins = model.skins.size();
    for (const tinygltf::Mesh& mesh : model.meshes) {
        facts.primitives += mesh.primitives.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            facts.morphTargets += primitive.targets.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            facts.colouredPrimitives += primitive.attributes.contains("COLOR_0") ? 1 : 0;
    }
    for (const gltf::Placement& placement : gltf::placeNodes(model))
        facts.instances += model.nodes[placement.node].mesh >= 0 ? 1 : 0;
}

void countMaterials(const Scene& scene, SceneFacts& facts) {
    for (const Material& material : scene.materials) {
        facts.maskedMaterials += material.alphaMode == AlphaMode::Mask ? 1 : 0;
        facts.blendedMaterials += material.alphaMode == AlphaMode::Blend ? 1 : 0;
        facts.transmissiveMaterials += material.transmission > 0.0f ? 1 : 0;
        facts.unlitMaterials += material.isUnlit ? 1 : 0;
    }
}

void countLights(const Scene& scene, SceneFacts& facts) {
    using Kind = PunctualLight::Kind;
    for (const PunctualLight& light : scene.lights) {
        facts.pointLights += light.kind == Kind::Point ? 1 : 0;
        facts.spotLights += light.kind == Kind::Spot ? 1 : 0;
        facts.directionalLights += light.kind == Kind::Directional ? 1 : 0;
    }
}

void countScene(Scene scene, SceneFacts& facts) {
    facts.triangles = scene.triangles.size();
    facts.vertices = scene.vertices.size();
    facts.nonFiniteTriangles = scene.notes.nonFiniteTriangles;
    facts.degenerateTriangles = scene.notes.degenerateTriangles;
    for (const TextureImage& image : scene.images) {
        facts.usedPictures.push_back({gltf::printable(image.name), image.width, image.height});
        facts.texels += image.rgba.size() / 4;
    }
    const auto emits = [](const Material& material) { return material.emission != glm::vec3(0.0f); };
    facts.emissiveMaterials = static_cast<uint64_t>(std::ranges::count_if(scene.materials, emits));
    facts.emissiveTriangles =
        static_cast<uint64_t>(std::ranges::count_if(scene.triangles, [&](const Triangle& triangle) {
            return emits(scene.materials[triangle.material]);
        }));
    countMaterials(scene, facts);
    countLights(scene, facts);
    const Bounds bounds = sceneBounds(scene);
    facts.lower = glm::dvec3(bounds.lower) + scene.origin;
    facts.upper = glm::dvec3(bounds.upper) + scene.origin;
    facts.cameras = std::move(scene.cameras);
    facts.warnings = std::move(scene.notes.warnings);
}

} // namespace

SceneFacts readSceneFacts(const std::filesystem::path& file) {
    try {
        const gltf::SourceFile source = gltf::openSource(file);
        const gltf::JsonFindings json = gltf::readJson(source);
        const tinygltf::Model model = gltf::parseModel(source, json);
        gltf::validateModel(source, model);
        SceneFacts facts;
        facts.format = gltf::isBinary(source) ? "glb" : "gltf";
        facts.bytes = source.bytes.size();
        for (const gltf::ExtensionUse& use : gltf::extensionsOf(json))
            facts.extensions.push_back({use.name, nameOf(use.support), use.isRequired, use.consequence});
        countModel(model, facts);
        countScene(gltf::assembleScene(source, model), facts);
        return facts;
    } catch (const std::bad_alloc&) {
        fail(ExitCode::OutOfMemory, "{}: not enough memory to load the scene", file.string());
    }
}

} // namespace irradia
