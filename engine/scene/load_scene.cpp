#include "engine/scene/load_scene.h"

#include "engine/scene/gltf/assemble.h"
#include "engine/scene/gltf/parse.h"
#include "engine/scene/gltf/validate.h"
#include <new>

namespace irradia {

Scene loadScene(const std::filesystem::path& file) {
    try {
        const gltf::SourceFile source = gltf::openSource(file);
        const tinygltf::Model model = gltf::parseModel(source, gltf::readJson(source));
        gltf::validateModel(source, model);
        return gltf::assembleScene(source, model);
    } catch (const std::bad_alloc&) {
        fail(ExitCode::OutOfMemory, "{}: not enough memory to load the scene", file.string());
    }
}

} // namespace irradia
