#include "request_options.h"

#include "methods.h"
#include "samples/session/kernel_form.h"
#include "samples/support/numbers.h"
#include "samples/support/program.h"
#include <fmt/ranges.h>

namespace irradia {
namespace {

void addSceneOptions(CLI::App& command, RenderRequest& request) {
    command.add_option("scene", request.scene, "glTF scene, .gltf or .glb")->required();
    command
        .add_option("--camera", request.camera,
                    "Camera by name, index or .json file: {\"camera\": {\"position\": [x,y,z], "
                    "\"look_at\": [x,y,z], \"up\": [x,y,z] (may be left out: +Y), \"vfov_deg\": degrees}, "
                    "\"env\": an .exr or .hdr beside the file, or [R,G,B] (may be left out; --env comes "
                    "first)}; \"aspect\" and what stands beside these two is ignored")
        ->group("Scene");
    command
        .add_option("--env", request.environment, "Environment: FILE.exr, FILE.exr:LAYER, FILE.hdr or R,G,B")
        ->group("Scene");
    command.add_flag("--strict", request.strict, "Warnings about the scene are errors")->group("Scene");
}

void addSize(CLI::App& command, RenderRequest& request) {
    const std::function<void(const std::string&)> read = [&request](const std::string& text) {
        request.size = parseSize(text);
    };
    command.add_option_function("--size", read, "Picture, WxH")
        ->group("Method")
        ->default_str(sizeText(request.size));
}

} // namespace

void addForm(CLI::App& command, std::string& form, const std::vector<std::string>& names,
             const std::string& help) {
    command.add_option("--form", form, help)
        ->check(CLI::IsMember(names))
        ->group("Device")
        ->capture_default_str();
}

void addRequestOptions(CLI::App& command, RenderRequest& request) {
    addSceneOptions(command, request);
    addMethodOptions(command, request.method, request.methodOptions);
    command
        .add_option("--view", request.view,
                    fmt::format("Instead of the picture: {}", fmt::join(viewNames(), ", ")))
        ->group("Method");
    command.add_option("--reference", request.reference, "EXR of the same size, for --view error-sign")
        ->group("Method");
    addSize(command, request);
    addWhole(command, "--spp", request.samplesPerFrame, "Samples of a pixel per frame", 1, 65536)
        ->group("Method")
        ->capture_default_str();
    addWhole(command, "--max-bounces", request.maxBounces,
             "A path has at most this + 2 edges, light connection included; 0 = emission and direct light", 0,
             1024)
        ->group("Method")
        ->capture_default_str();
    addWhole(command, "--seed", request.seed, "Of the random numbers", 0, UINT32_MAX)
        ->group("Method")
        ->capture_default_str();
    command
        .add_option("--sampler", request.sampler,
                    "Numbers of a pixel's samples: sobol (spread evenly, Owen-scrambled) or random "
                    "(independent)")
        ->type_name("NAME")
        ->group("Method")
        ->capture_default_str();
    command.add_option("--device", request.device.select, "Index, name, cpu or gpu")->group("Device");
    command.add_flag("--validation", request.device.validation, "Vulkan's validation layers")
        ->group("Device");
    addSubgroup(command, request.device.subgroupSize)->group("Device");
    addForm(
        command, request.form, kernelFormNames(),
        "Of the kernels: texel or storage (how they read queues), subgroup or workgroup (how they compute "
        "networks, in place of what the model says), or auto");
}

std::string sizeText(glm::uvec2 size) {
    return fmt::format("{}x{}", size.x, size.y);
}

} // namespace irradia
