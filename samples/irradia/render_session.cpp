#include "render_session.h"

#include "engine/error.h"
#include "engine/image/metrics.h"
#include "engine/image/picture_file.h"
#include "engine/log.h"
#include "engine/scene/area_table.h"
#include "engine/scene/scene_box.h"
#include "methods.h"
#include "nrc/renderer/picture_memory.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/program.h"
#include <chrono>
#include <cstdio>
#include <fmt/ranges.h>

namespace irradia {

namespace {

RecordAccess parseRecords(const std::string& text) {
    if (text == "texel") return RecordAccess::Texel;
    if (text == "storage") return RecordAccess::Storage;
    return RecordAccess::Auto;
}

uint32_t parseSampler(const std::string& text) {
    if (text == "sobol") return gpu::kSamplerSobol;
    if (text == "random") return gpu::kSamplerRandom;
    fail(ExitCode::Usage, "--sampler {} is unknown; there are sobol and random", text);
}

NrcConfig nrcConfig(const RenderRequest& request) {
    NrcConfig config =
        request.preset.ends_with(".json") ? loadNrcConfig(request.preset) : nrcPreset(request.preset);
    if (!request.network.empty()) config.model = loadCacheModel(request.network);
    return config;
}

std::vector<glm::vec3> loadReference(const View& view, const std::string& file, glm::uvec2 size) {
    if (view.isErrorSign && file.empty()) fail(ExitCode::Usage, "--view {} needs a --reference", view.name);
    if (file.empty()) return {};
    if (!view.isErrorSign) fail(ExitCode::Usage, "--reference is for --view error-sign");
    const LayeredImage image = readExr(file);
    if (glm::uvec2(image.width, image.height) != size)
        fail(ExitCode::BadData, "{} has {} x {} pixels, but the picture will have {} x {}", file, image.width,
             image.height, size.x, size.y);
    const std::vector<glm::vec3> pixels = image.rgb();
    checkReference(image.width, pixels);
    return pixels;
}

std::vector<std::string> sceneWarnings(const Scene& scene, const std::vector<std::string>& packingWarnings) {
    std::vector<std::string> warnings;
    const SceneNotes& notes = scene.notes;
    if (notes.nonFiniteTriangles + notes.degenerateTriangles > 0)
        warnings.push_back(fmt::format("dropped {} degenerate and {} non-finite triangles",
                                       notes.degenerateTriangles, notes.nonFiniteTriangles));
    warnings.insert(warnings.end(), notes.warnings.begin(), notes.warnings.end());
    warnings.insert(warnings.end(), packingWarnings.begin(), packingWarnings.end());
    return warnings;
}

void reportScene(const RenderRequest& request, const Scene& scene,
                 const std::vector<std::string>& packingWarnings) {
    logLine("scene {}: {} triangles, {} materials, {} pictures", scene.name, scene.triangles.size(),
            scene.materials.size(), scene.images.size());
    if (scene.origin != glm::dvec3(0.0))
        logLine("scene {}: it stands about ({:g}, {:g}, {:g})", scene.name, scene.origin.x, scene.origin.y,
                scene.origin.z);
    const std::vector<std::string> warnings = sceneWarnings(scene, packingWarnings);
    if (request.strict && !warnings.empty())
        fail(ExitCode::BadData, "{}: --strict allows no warning, and there {} {}: {}", request.scene,
             warnings.size() == 1 ? "is" : "are", warnings.size(), fmt::join(warnings, "; "));
    for (const std::string& warning : warnings) logLine("warning: {}", warning);
}

// What is no name of a preset or a camera.
std::string fileOnly(const std::string& text) {
    return text.ends_with(".json") ? text : "";
}

} // namespace

void addRequestOptions(CLI::App& command, RenderRequest& request) {
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
    command
        .add_option(
            "--method", request.method,
            "pt (path tracing), nrc (with a radiance cache) or cache-view (the cache at the first hit)")
        ->group("Method")
        ->capture_default_str();
    command
        .add_option("--preset", request.preset,
                    fmt::format("Of the cache: {}, or a .json file, which may inherit what it does not give: "
                                "{{\"base\": \"balanced\", ...}}",
                                fmt::join(nrcPresetNames(), ", ")))
        ->group("Method")
        ->capture_default_str();
    command
        .add_option("--view", request.view,
                    fmt::format("Instead of the picture: {}", fmt::join(viewNames(), ", ")))
        ->group("Method");
    command.add_option("--reference", request.reference, "EXR of the same size, for --view error-sign")
        ->group("Method");
    command
        .add_option("--network", request.network,
                    "Model of the cache, a .json file; with a \"base\", that preset's model changed")
        ->group("Method");
    command.add_option("--size", request.size, "Picture, WxH")->group("Method")->capture_default_str();
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
    command.add_option("--records", request.records, "Form of the kernels: auto, texel or storage")
        ->check(CLI::IsMember({"auto", "texel", "storage"}))
        ->group("Device");
}

std::vector<NamedFile> inputFiles(const RenderRequest& request) {
    return {{"the scene", request.scene},
            {"the camera", fileOnly(request.camera)},
            {"the environment", parsePictureName(request.environment).file.string()},
            {"the preset", fileOnly(request.preset)},
            {"the network", request.network},
            {"the list of changes", request.changes},
            {"the reference", request.reference}};
}

RenderSession::RenderSession(const RenderRequest& request)
    : request_(request)
    , size_(parseSize(request.size)) {
    if (methodHasCache(request.method)) preset_ = nrcConfig(request);
    view_ = findView(request.view);
    reference_ = loadReference(view_, request.reference, size_);
    request_.device.records = parseRecords(request.records);
    const NrcOptions options = rendererOptions();
    device_ = std::make_unique<Device>(request_.device);
    requireRoomForPicture(*device_, options, hasCache());

    scene_ = loadScene(request.scene);
    const CameraFile chosen = chooseCamera(scene_, request.camera);
    camera_ = chosen.camera;
    environment_ = request.environment.empty() ? chosen.environment : request.environment;
    if (!environment_.empty()) scene_.environment = loadEnvironment(environment_, &scene_.notes);

    if (!request.changes.empty()) changes_ = ScriptedChanges(request.changes, scene_);
    if (request.endFrame) changes_.requireBefore(*request.endFrame);
    SceneRecords records = packScene(scene_, changes_.states(scene_));
    if (options.config.uniformShare > 0.0f) packAreaTable(records);
    if (!request.heading.empty()) logLine("{}", request.heading);
    reportScene(request_, scene_, records.warnings);
    logLine("device {} ({}), subgroups of {}, {} records", device_->description().name,
            device_->description().driver, device_->subgroupSize(),
            device_->texelRecords() ? "texel" : "storage");
    stopIfInterrupted();
    const Bvh bvh = buildBvh(scene_);
    stopIfInterrupted();
    createRenderer(options, records, bvh);
}

std::vector<NamedFile> RenderSession::inputs() const {
    std::vector<NamedFile> files = inputFiles(request_);
    files.push_back({"the environment", parsePictureName(environment_).file.string()});
    for (const std::filesystem::path& file : scene_.files)
        files.push_back({"a file of the scene", file.string()});
    return files;
}

bool RenderSession::hasCache() const {
    return methodHasCache(request_.method);
}

NrcOptions RenderSession::rendererOptions() const {
    NrcOptions options;
    options.paths.width = size_.x;
    options.paths.height = size_.y;
    options.paths.maxBounces = request_.maxBounces;
    options.paths.samplesPerFrame = request_.samplesPerFrame;
    options.paths.seed = request_.seed;
    options.paths.sampler = parseSampler(request_.sampler);
    options.paths.surfaces = request_.surfaces;
    options.seed = request_.seed;
    if (!hasCache()) return options;
    options.config = preset_;
    if (request_.method == "cache-view") options.config.endDepth = 0;
    view_.applyTo(options);
    return options;
}

void RenderSession::createRenderer(const NrcOptions& options, const SceneRecords& records, const Bvh& bvh) {
    auto plan = plannedBuffers(records, bvh);
    for (auto& buffer : pictureBuffers(*device_, options, hasCache())) plan.push_back(std::move(buffer));
    device_->plan(plan);
    gpuScene_ = uploadScene(*device_, records, bvh);
    if (hasCache())
        nrc_ = std::make_unique<NrcRenderer>(*device_, gpuScene_, sceneBox(scene_), options, &profiler_);
    else
        tracer_ = std::make_unique<WavefrontPathTracer>(*device_, gpuScene_, options.paths, &profiler_);
}

void RenderSession::applyChanges(uint32_t frame) {
    bool isChanged = false;
    for (const SceneChange& change : changes_.takeUpTo(frame)) {
        change.applyTo(scene_);
        isChanged = isChanged || change.changesScene();
        if (change.camera) camera_ = *change.camera;
        if (change.restart) forgetFilm();
    }
    if (isChanged) updateScene(*device_, scene_, gpuScene_);
}

double RenderSession::renderFrame(uint32_t number) {
    applyChanges(number);
    return renderWith(number);
}

double RenderSession::renderWarmupFrame(uint32_t index) {
    applyChanges(request_.firstFrame);
    if (nrc_) nrc_->setWarmingUp(true);
    return renderWith(UINT32_MAX - index);
}

double RenderSession::renderWith(uint32_t randomIndex) {
    const auto start = std::chrono::steady_clock::now();
    if (nrc_)
        nrc_->renderFrame(camera_, randomIndex);
    else
        tracer_->renderFrame(camera_, randomIndex);
    const double wall =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    profiler_.endFrame(wall);
    return wall;
}

FilmImage RenderSession::readFilm() const {
    FilmImage film = tracer().readFilm();
    requireFrames(film);
    view_.finish(film, reference_);
    return film;
}

void RenderSession::forgetFilm() {
    if (nrc_)
        nrc_->forgetFilm();
    else
        tracer_->forgetFilm();
}

void RenderSession::endWarmup() {
    if (nrc_) nrc_->setWarmingUp(false);
    forgetFilm();
    profiler_.reset();
}

} // namespace irradia
