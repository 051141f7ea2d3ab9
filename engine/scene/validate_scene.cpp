#include "engine/scene/validate_scene.h"

#include "engine/image/read_file.h"
#include "engine/scene/gltf/assemble.h"
#include "engine/scene/gltf/explain.h"
#include "engine/scene/gltf/features.h"
#include "engine/scene/gltf/inspect.h"
#include "engine/scene/gltf/materials.h"
#include "engine/scene/gltf/parse.h"
#include "engine/scene/gltf/primitives.h"
#include "engine/scene/gltf/validate.h"
#include <exception>
#include <new>

namespace irradia {
namespace {

void warnOfLostTriangles(const gltf::SourceFile& source, const SceneNotes& notes) {
    if (notes.nonFiniteTriangles > 0)
        source.note(Severity::Warning, "/meshes", "ACCESSOR_INVALID_FLOAT",
                    fmt::format("{} triangles with corners that are not finite are left out",
                                notes.nonFiniteTriangles));
    if (notes.degenerateTriangles > 0)
        source.note(Severity::Warning, "/meshes", "ACCESSOR_INDEX_TRIANGLE_DEGENERATE",
                    fmt::format("{} triangles without area are left out", notes.degenerateTriangles));
}

void readMeshes(const gltf::SourceFile& source, const tinygltf::Model& model, const Scene& scene) {
    for (size_t i = 0; i < model.meshes.size(); ++i)
        gltf::readMesh(source, model, static_cast<int>(i), gltf::poseOf(model.meshes[i]), scene);
}

// What can only be told in reading, of as much as is sound.
void readThrough(const gltf::SourceFile& source, const tinygltf::Model& model, const gltf::Soundness& sound) {
    Scene scene;
    if (!sound.data || !sound.materials) return gltf::noteIgnoredFeatures(source, model);
    if (sound.meshes && sound.nodes && sound.cameras && sound.skins && sound.lights) {
        scene = gltf::assembleScene(source, model);
        warnOfLostTriangles(source, scene.notes);
    } else {
        gltf::noteIgnoredFeatures(source, model);
        gltf::readMaterials(source, model, scene);
    }
    if (sound.meshes) readMeshes(source, model, scene); // those that no node places, too
}

void check(const gltf::SourceFile& source) {
    const gltf::JsonFindings json = gltf::readJson(source);
    tinygltf::Model model;
    std::exception_ptr refusal; // a sentence of the parser's, without a place
    try {
        if (source.findings->errors() == 0) model = gltf::parseModel(source, json);
    } catch (const Error&) {
        refusal = std::current_exception();
    }
    if (!refusal && source.findings->errors() == 0) {
        const gltf::Soundness sound = gltf::validateModel(source, model);
        if (sound.data) gltf::inspectAccessors(source, model);
        gltf::inspectAnimations(source, model);
        return readThrough(source, model, sound);
    }
    const size_t before = source.findings->errors();
    gltf::reportSchemaFaults(source);
    if (refusal && source.findings->errors() == before)
        source.attempt({}, {}, [&] { std::rethrow_exception(refusal); });
}

} // namespace

std::vector<Finding> validateScene(const std::filesystem::path& file) {
    gltf::SourceFile source{.path = file,
                            .findings = std::make_shared<gltf::Findings>(gltf::Findings::Mode::Collect)};
    requireFile(file);
    try {
        source.attempt({}, {}, [&] {
            source.bytes = gltf::openSource(file).bytes;
            check(source);
        });
    } catch (const std::bad_alloc&) {
        fail(ExitCode::OutOfMemory, "{}: not enough memory to load the scene", file.string());
    }
    return source.findings->all();
}

} // namespace irradia
