#include "engine/scene/gltf/materials.h"

#include "engine/scene/gltf/textures.h"
#include <algorithm>
#include <cmath>

namespace irradia::gltf {
namespace {

class MaterialReader {
public:
    MaterialReader(const SourceFile& source, const tinygltf::Material& from, size_t index,
                   const TextureReader& textures)
        : source_(source)
        , from_(from)
        , values_(source, thing("material", "materials", index, from.name))
        , textures_(textures) {}

    Material read() {
        Material material;
        material.name = from_.name;
        readBaseColour(material);
        if (find("KHR_materials_unlit")) {
            noteUnlit();
            return unlit(std::move(material));
        }
        material.doubleSided = from_.doubleSided;
        readMetallicRoughness(material);
        readSpecularGlossiness(material);
        readNormals(material);
        readEmission(material);
        readIor(material);
        readSpecular(material);
        readTransmission(material);
        readVolume(material);
        return material;
    }

private:
    void readBaseColour(Material& material) {
        const auto& pbr = from_.pbrMetallicRoughness;
        material.baseColor = values_.colour("baseColorFactor", pbr.baseColorFactor, 1);
        material.alpha = values_.number("baseColorFactor", pbr.baseColorFactor[3], 0, 1);
        material.baseColorTexture = texture(pbr.baseColorTexture);
        if (from_.alphaMode == "MASK") material.alphaMode = AlphaMode::Mask;
        if (from_.alphaMode == "BLEND") material.alphaMode = AlphaMode::Blend;
        material.alphaCutoff = values_.number("alphaCutoff", from_.alphaCutoff, 0, kMaxScale);
    }

    // KHR_materials_transmission forbids to stand beside KHR_materials_unlit.
    void noteUnlit() const {
        if (find("KHR_materials_transmission"))
            source_.note(Severity::Info, values_.owner().pointer, kNotRendered,
                         values_.owner().name + ": KHR_materials_unlit makes it unlit, and its "
                                                "KHR_materials_transmission is ignored");
    }

    // Shows its base colour as it is: a lamp that reflects nothing.
    static Material unlit(Material material) {
        material.isUnlit = true;
        material.doubleSided = true;
        material.emission = material.emissiveFactor = material.baseColor;
        material.emissiveTexture = material.baseColorTexture; // which keeps its alpha
        material.baseColor = glm::vec3(0.0f);
        material.metallic = material.specular = 0.0f;
        return material;
    }

    void readMetallicRoughness(Material& material) {
        const auto& pbr = from_.pbrMetallicRoughness;
        material.metallic = values_.number("metallicFactor", pbr.metallicFactor, 0, 1);
        material.roughness = values_.number("roughnessFactor", pbr.roughnessFactor, 0, 1);
        material.metallicRoughnessTexture = texture(pbr.metallicRoughnessTexture);
    }

    // KHR_materials_pbrSpecularGlossiness as a dielectric whose F0 is the specular colour: KHR_materials_ior
    // sets ior = 0, F0 = 1 aside for this.
    void readSpecularGlossiness(Material& material) {
        const Extension extension = find("KHR_materials_pbrSpecularGlossiness");
        if (!extension) return;
        material.baseColor = values_.colour(*extension, "diffuseFactor", 1);
        const std::vector<double> diffuse = numbers(*extension, "diffuseFactor");
        material.alpha = values_.number("diffuseFactor", diffuse.size() < 4 ? 1.0 : diffuse[3], 0, 1);
        material.baseColorTexture = texture(*extension, "diffuseTexture");
        material.metallic = 0.0f;
        material.metallicRoughnessTexture = {};
        material.roughness = 1.0f - values_.number(*extension, "glossinessFactor", 1, 0, 1);
        material.ior = 0.0f;
        material.specularColor = values_.colour(*extension, "specularFactor", 1);
        material.specularColorTexture = texture(*extension, "specularGlossinessTexture");
        if (material.specularColorTexture.image >= 0)
            source_.note(Severity::Info, values_.owner().pointer, kNotRendered,
                         "the glossiness channel of specular-glossiness textures is ignored");
    }

    void readNormals(Material& material) {
        material.normalScale =
            values_.number("normalTexture.scale", from_.normalTexture.scale, -kMaxScale, kMaxScale);
        material.normalTexture = texture(from_.normalTexture);
    }

    void readEmission(Material& material) {
        const Extension extension = find("KHR_materials_emissive_strength");
        const double strength = extension ? plainNumber(*extension, "emissiveStrength", 1) : 1.0;
        std::vector<double> radiance = from_.emissiveFactor;
        material.emissiveFactor = values_.colour("emissiveFactor", radiance, kMaxRadiance);
        for (double& channel : radiance) channel *= strength;
        material.emission = values_.colour("emissiveFactor x emissiveStrength", radiance, kMaxRadiance);
        material.emissiveTexture = texture(from_.emissiveTexture);
    }

    void readIor(Material& material) {
        const Extension extension = find("KHR_materials_ior");
        if (!extension) return;
        const double ior = plainNumber(*extension, "ior", 1.5);
        material.ior = static_cast<float>(ior == 0 ? 0.0 : std::clamp(ior, 1.0, kMaxScale));
        if (ior != 0 && (ior < 1 || ior > kMaxScale)) // 0 lets specular-glossiness have its way
            source_.note(Severity::Warning, values_.owner().pointer, "VALUE_NOT_IN_RANGE",
                         fmt::format("{}: ior {} is neither 0 nor in 1 to {} and was clamped",
                                     values_.owner().name, ior, kMaxScale));
    }

    void readSpecular(Material& material) {
        const Extension extension = find("KHR_materials_specular");
        if (!extension) return;
        material.specular = values_.number(*extension, "specularFactor", 1, 0, 1);
        material.specularColor = values_.colour(*extension, "specularColorFactor", kMaxScale);
        material.specularTexture = texture(*extension, "specularTexture");
        material.specularColorTexture = texture(*extension, "specularColorTexture");
    }

    void readTransmission(Material& material) {
        const Extension extension = find("KHR_materials_transmission");
        if (!extension) return;
        material.transmission = values_.number(*extension, "transmissionFactor", 0, 0, 1);
        material.transmissionTexture = texture(*extension, "transmissionTexture");
    }

    // The thickness itself is for rasterizers: rays find the other side, wherever it is.
    void readVolume(Material& material) {
        const Extension extension = find("KHR_materials_volume");
        if (!extension) return;
        material.isThin = values_.number(*extension, "thicknessFactor", 0, 0, kMaxRadiance) == 0.0f;
        const bool isFinite = member(*extension, "attenuationDistance").IsNumber(); // by default it is not
        if (material.isThin || !isFinite) return;
        constexpr double kLeast = 1e-6; // black would be dense beyond any number
        const double distance = values_.number(*extension, "attenuationDistance", 0, 1e-20, 1e30);
        const glm::vec3 colour = values_.colour(*extension, "attenuationColor", 1);
        material.absorption = 0.0 - glm::log(glm::max(glm::dvec3(colour), kLeast)) / distance;
    }

    Extension find(const std::string& name) const { return findExtension(from_.extensions, name); }

    template <typename... Info>
    TextureRef texture(const Info&... info) const {
        return textures_.read(values_, textureInfo(info...));
    }

    const SourceFile& source_;
    const tinygltf::Material& from_;
    Values values_;
    const TextureReader& textures_;
};

bool needsDefault(const tinygltf::Model& model) {
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            if (primitive.material < 0) return true;
    return false;
}

} // namespace

void readMaterials(const SourceFile& source, const tinygltf::Model& model, Scene& scene) {
    ImageTable images(source, model, scene.images);
    const TextureReader textures(source, model, images);
    for (size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(MaterialReader(source, model.materials[i], i, textures).read());
    if (needsDefault(model)) scene.materials.push_back({.name = "default"});
    images.decode();
}

} // namespace irradia::gltf
