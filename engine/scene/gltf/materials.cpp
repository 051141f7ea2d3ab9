#include "engine/scene/gltf/materials.h"

#include "engine/scene/gltf/images.h"
#include <algorithm>
#include <cmath>

namespace irradia::gltf {
namespace {

constexpr double kMaxRadiance = 1e20; // keeps products of radiance and throughput inside float
constexpr double kMaxScale = 1e6;

class MaterialReader {
public:
    MaterialReader(const SourceFile& source, const tinygltf::Model& model, size_t index, ImageTable& images)
        : source_(source)
        , model_(model)
        , from_(model.materials[index])
        , owner_(thing("material", "materials", index, from_.name))
        , images_(images) {}

    Material read() {
        Material material;
        material.name = from_.name;
        material.doubleSided = from_.doubleSided;
        readMetallicRoughness(material);
        readSpecularGlossiness(material);
        readSurface(material);
        readEmission(material);
        readIor(material);
        readSpecular(material);
        return material;
    }

private:
    using Extension = const tinygltf::Value*; // an object, or null

    void readMetallicRoughness(Material& material) {
        const auto& pbr = from_.pbrMetallicRoughness;
        material.baseColor = colour("baseColorFactor", pbr.baseColorFactor, 1);
        material.metallic = number("metallicFactor", pbr.metallicFactor, 0, 1);
        material.roughness = number("roughnessFactor", pbr.roughnessFactor, 0, 1);
        material.baseColorTexture = texture(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord);
        material.metallicRoughnessTexture =
            texture(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord);
    }

    // KHR_materials_pbrSpecularGlossiness as a dielectric whose F0 is the specular colour: KHR_materials_ior
    // sets ior = 0, F0 = 1 aside for this.
    void readSpecularGlossiness(Material& material) {
        const Extension extension = find("KHR_materials_pbrSpecularGlossiness");
        if (!extension) return;
        material.baseColor = colour(*extension, "diffuseFactor", 1);
        material.baseColorTexture = texture(*extension, "diffuseTexture");
        material.metallic = 0.0f;
        material.metallicRoughnessTexture = {};
        material.roughness = 1.0f - number(*extension, "glossinessFactor", 1, 0, 1);
        material.ior = 0.0f;
        material.specularColor = colour(*extension, "specularFactor", 1);
        material.specularColorTexture = texture(*extension, "specularGlossinessTexture");
        if (material.specularColorTexture.image >= 0)
            source_.note(Severity::Info, owner_.pointer, kNotRendered,
                         "the glossiness channel of specular-glossiness textures is ignored");
    }

    void readSurface(Material& material) {
        material.normalScale =
            number("normalTexture.scale", from_.normalTexture.scale, -kMaxScale, kMaxScale);
        material.normalTexture = texture(from_.normalTexture.index, from_.normalTexture.texCoord);
    }

    void readEmission(Material& material) {
        const Extension extension = find("KHR_materials_emissive_strength");
        const double strength = extension ? plain(*extension, "emissiveStrength", 1) : 1.0;
        std::vector<double> radiance = from_.emissiveFactor;
        material.emissiveFactor = colour("emissiveFactor", radiance, kMaxRadiance);
        for (double& channel : radiance) channel *= strength;
        material.emission = colour("emissiveFactor x emissiveStrength", radiance, kMaxRadiance);
        material.emissiveTexture = texture(from_.emissiveTexture.index, from_.emissiveTexture.texCoord);
    }

    void readIor(Material& material) {
        const Extension extension = find("KHR_materials_ior");
        if (!extension) return;
        const double ior = plain(*extension, "ior", 1.5);
        material.ior = ior == 0 ? 0.0f : number("ior", ior, 1, kMaxScale);
    }

    void readSpecular(Material& material) {
        const Extension extension = find("KHR_materials_specular");
        if (!extension) return;
        material.specular = number(*extension, "specularFactor", 1, 0, 1);
        material.specularColor = colour(*extension, "specularColorFactor", kMaxScale);
        material.specularTexture = texture(*extension, "specularTexture");
        material.specularColorTexture = texture(*extension, "specularColorTexture");
    }

    Extension find(const std::string& name) const {
        const auto found = from_.extensions.find(name);
        return found != from_.extensions.end() && found->second.IsObject() ? &found->second : nullptr;
    }

    static double plain(const tinygltf::Value& extension, const std::string& key, double otherwise) {
        const tinygltf::Value& value = extension.Get(key);
        return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
    }

    float number(const tinygltf::Value& extension, const std::string& key, double otherwise, double low,
                 double high) {
        return number(key, plain(extension, key, otherwise), low, high);
    }

    float number(const std::string& key, double value, double low, double high) {
        const double clamped = std::isnan(value) ? low : std::clamp(value, low, high);
        if (clamped != value)
            warn(owner_, "VALUE_NOT_IN_RANGE",
                 fmt::format("{}: {} {} is outside {} to {} and was clamped", owner_.name, key, value, low,
                             high));
        return static_cast<float>(clamped);
    }

    glm::vec3 colour(const tinygltf::Value& extension, const std::string& key, double high) {
        std::vector<double> values;
        const tinygltf::Value& array = extension.Get(key);
        for (size_t i = 0; i < array.ArrayLen(); ++i)
            values.push_back(array.Get(static_cast<int>(i)).GetNumberAsDouble());
        return values.size() < 3 ? glm::vec3(1.0f) : colour(key, values, high);
    }

    glm::vec3 colour(const std::string& key, const std::vector<double>& values, double high) {
        return {number(key, values[0], 0, high), number(key, values[1], 0, high),
                number(key, values[2], 0, high)};
    }

    TextureRef texture(const tinygltf::Value& extension, const std::string& key) {
        const tinygltf::Value& info = extension.Get(key);
        if (!info.IsObject() || !info.Has("index")) return {};
        const tinygltf::Value& set = info.Get("texCoord");
        return texture(info.Get("index").GetNumberAsInt(), set.IsNumber() ? set.GetNumberAsInt() : 0);
    }

    TextureRef texture(int index, int uvSet) {
        if (index < 0) return {};
        const tinygltf::Texture& from = model_.textures[index];
        const Thing owner = thing("texture", "textures", static_cast<size_t>(index), from.name);
        if (uvSet > 1) {
            warn(owner_, kNotRendered,
                 fmt::format("{}: texture {} uses coordinate set {}, only 0 and 1 can be used", owner_.name,
                             index, uvSet));
            return {};
        }
        if (from.source < 0) {
            warn(owner, kNotRendered, owner.name + " has no picture of a supported format");
            return {};
        }
        bool isMissing = false;
        const Thing image = thing("image", "images", static_cast<size_t>(from.source)).at("uri");
        if (!source_.attempt(image, "INVALID_URI", [&] { isMissing = images_.isMissing(from.source); }))
            return {};
        if (isMissing) {
            warn(image, "IO_ERROR",
                 fmt::format("{} is left out: {} is missing", owner.name, images_.nameOf(from.source)));
            return {};
        }
        TextureRef ref{images_.use(from.source), uvSet, Wrap::Repeat, Wrap::Repeat};
        if (from.sampler >= 0) {
            ref.wrapS = wrap(model_.samplers[from.sampler].wrapS);
            ref.wrapT = wrap(model_.samplers[from.sampler].wrapT);
        }
        return ref;
    }

    void warn(const Thing& at, std::string_view code, const std::string& sentence) const {
        source_.note(Severity::Warning, at.pointer, code, sentence);
    }

    static Wrap wrap(int mode) {
        if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::ClampToEdge;
        return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat : Wrap::Repeat;
    }

    const SourceFile& source_;
    const tinygltf::Model& model_;
    const tinygltf::Material& from_;
    Thing owner_;
    ImageTable& images_;
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
    for (size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(MaterialReader(source, model, i, images).read());
    if (needsDefault(model)) scene.materials.push_back({.name = "default"});
    images.decode();
}

} // namespace irradia::gltf
