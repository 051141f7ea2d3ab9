#include "samples/session/render_session.h"

#include "engine/error.h"
#include "engine/image/metrics.h"
#include "engine/image/picture_file.h"
#include "engine/log.h"
#include "engine/scene/lights/area_table.h"
#include "engine/scene/scene_box.h"
#include "nrc/renderer/picture_memory.h"
#include "samples/session/kernel_form.h"
#include <chrono>
#include <fmt/ranges.h>

namespace irradia {
namespace {

uint32_t parseSampler(const std::string& text) {
    if (text == "sobol") return gpu::kSamplerSobol;
    if (text == "random") return gpu::kSamplerRandom;
    fail(ExitCode::Usage, "--sampler {} is unknown; there are sobol and random", text);
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

std::vector<NamedFile> inputFiles(const RenderRequest& request) {
    std::vector<NamedFile> files{{"the scene", request.scene},
                                 {"the camera", fileOnly(request.camera)},
                                 {"the environment", parsePictureName(request.environment).file.string()},
                                 {"the list of changes", request.changes},
                                 {"the reference", request.reference}};
    for (const MethodOption& option : findMethod(request.method).options) {
        const std::string value = valueOf(request.methodOptions, option);
        if (!option.file.empty()) files.push_back({option.file, option.takesNames ? fileOnly(value) : value});
    }
    return files;
}

RenderSession::RenderSession(const RenderRequest& request)
    : request_(request)
    , method_(&findMethod(request.method))
    , view_(findView(request.view))
    , setup_(method_->setup(methodRequest()))
    , reference_(loadReference(view_, request.reference, request.size)) {
    request_.device.quads = kernelForm(request.form).access;
    device_ = std::make_unique<Device>(request_.device);
    requireRoomForPicture(*device_, *setup_);

    scene_ = loadScene(request.scene);
    const CameraFile chosen = chooseCamera(scene_, request.camera);
    camera_ = chosen.camera;
    environment_ = request.environment.empty() ? chosen.environment : request.environment;
    if (!environment_.empty()) scene_.environment = loadEnvironment(environment_, &scene_.notes);
    requireApplies(*method_, scene_);

    if (!request.changes.empty()) changes_ = ScriptedChanges(request.changes, scene_);
    if (request.endFrame) changes_.requireBefore(*request.endFrame);
    openScene();
    createRenderer();
}

std::vector<NamedFile> RenderSession::inputs() const {
    std::vector<NamedFile> files = inputFiles(request_);
    files.push_back({"the environment", parsePictureName(environment_).file.string()});
    for (const std::filesystem::path& file : scene_.files)
        files.push_back({"a file of the scene", file.string()});
    return files;
}

MethodRequest RenderSession::methodRequest() const {
    MethodRequest method;
    method.paths.width = request_.size.x;
    method.paths.height = request_.size.y;
    method.paths.maxBounces = request_.maxBounces;
    method.paths.samplesPerFrame = request_.samplesPerFrame;
    method.paths.seed = request_.seed;
    method.paths.sampler = parseSampler(request_.sampler);
    method.paths.layers = request_.layers;
    method.seed = request_.seed;
    method.options = request_.methodOptions;
    method.form = kernelForm(request_.form).network;
    view_.applyTo(method);
    return method;
}

void RenderSession::step() const {
    if (request_.betweenSteps) request_.betweenSteps();
}

// Onto the device, where it and the renderer's buffers fit.
void RenderSession::openScene() {
    PackedScene packed = packScene(scene_, changes_.states(scene_));
    if (setup_->needsAreaTable()) packAreaTable(packed);
    if (!request_.heading.empty()) logLine("{}", request_.heading);
    reportScene(request_, scene_, packed.warnings);
    logLine("device {} ({}), subgroups of {}, {} quads", device_->description().name,
            device_->description().driver, device_->subgroupSize(), accessName(*device_));
    step();
    const Bvh bvh = buildBvh(scene_);
    step();
    auto plan = plannedBuffers(packed, bvh);
    for (auto& buffer : pictureBuffers(*device_, *setup_)) plan.push_back(std::move(buffer));
    device_->plan(plan);
    gpuScene_ = uploadScene(*device_, packed, bvh);
}

void RenderSession::createRenderer() {
    renderer_ = setup_->make({*device_, gpuScene_, sceneBox(scene_), &profiler_});
    renderer_->prepare([this](double /*share*/) {
        step();
        return true;
    });
}

void RenderSession::setMethod(const std::string& method, const std::map<std::string, std::string>& options) {
    RenderRequest wanted = request_;
    wanted.method = method;
    wanted.methodOptions = options;
    std::swap(request_, wanted);
    try {
        const Method& found = findMethod(method);
        requireApplies(found, scene_);
        auto setup = found.setup(methodRequest());
        renderer_.reset(); // frees its memory
        requireRoomForPicture(*device_, *setup);
        method_ = &found;
        setup_ = std::move(setup);
    } catch (...) {
        std::swap(request_, wanted);
        if (!renderer_) createRenderer(); // the one there was, anew
        throw;
    }
    if (setup_->needsAreaTable() && !gpuScene_.areaTable)
        openScene();
    else
        device_->plan(pictureBuffers(*device_, *setup_));
    createRenderer();
    profiler_.reset();
}

void RenderSession::change(const SceneChange& change) {
    if (apply(change)) updateScene(*device_, scene_, gpuScene_);
}

bool RenderSession::apply(const SceneChange& change) {
    change.applyTo(scene_);
    if (change.camera) camera_ = *change.camera;
    if (change.restart) forgetFilm();
    return change.changesScene();
}

void RenderSession::setCamera(const Camera& camera) {
    camera_ = camera;
    forgetFilm();
}

void RenderSession::applyChanges(uint32_t frame) {
    bool isChanged = false;
    for (const SceneChange& change : changes_.takeUpTo(frame)) isChanged = apply(change) || isChanged;
    if (isChanged) updateScene(*device_, scene_, gpuScene_);
}

double RenderSession::renderFrame(uint32_t number) {
    applyChanges(number);
    return renderWith(number);
}

double RenderSession::renderWarmupFrame(uint32_t index) {
    applyChanges(request_.firstFrame);
    renderer_->setWarmingUp(true);
    return renderWith(UINT32_MAX - index);
}

double RenderSession::renderWith(uint32_t randomIndex) {
    const auto start = std::chrono::steady_clock::now();
    renderer_->renderFrame(camera_, randomIndex);
    const double wall =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    profiler_.endFrame(wall);
    return wall;
}

FilmImage RenderSession::readRawFilm() const {
    FilmImage film = renderer_->readFilm();
    requireFrames(film);
    return film;
}

FilmImage RenderSession::readFilm() const {
    FilmImage film = readRawFilm();
    view_.finish(film, reference_);
    return film;
}

std::map<std::string, std::string> RenderSession::attributes() const {
    auto attributes = setup_->attributes();
    attributes.merge(renderer_->attributes());
    return attributes;
}

void RenderSession::forgetFilm() {
    renderer_->forgetFilm();
}

void RenderSession::endWarmup() {
    renderer_->setWarmingUp(false);
    forgetFilm();
    profiler_.reset();
}

} // namespace irradia
