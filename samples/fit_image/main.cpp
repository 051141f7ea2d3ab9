// fit_image: learns a picture as a function of place, with any encoding and network; or paints one to learn.
#include "engine/error.h"
#include "samples/fit_image/fit_image.h"
#include "samples/fit_image/make_picture.h"
#include "samples/support/interrupt.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"
#include "samples/support/program.h"
#include "samples/support/progress.h"

namespace irradia {
namespace {

struct Request {
    FitOptions fit;
    std::string makePicture;
    std::string size = "512x512";
};

void addOutputs(CLI::App& program, FitOptions& fit) {
    const auto add = [&](const char* name, std::string& file, const char* what) {
        return addOutput(program, name, file, what)->group("Output");
    };
    add("-o,--output", fit.output, "The learned picture, EXR, linear");
    add("--png", fit.png, "The same as a screen shows it");
    add("--csv", fit.csv, "step,seconds,loss,psnr; - for stdout");
    CLI::Option* chart = add("--chart", fit.chart, "PSNR and loss over time, SVG");
    program.add_option("--against", fit.against, "CSV files of earlier runs, drawn in the same chart")
        ->needs(chart)
        ->group("Output");
    add("--save", fit.save, "The model");
    add("--json", fit.json, "The run's numbers; - for stdout");
}

void addLearning(CLI::App& program, FitOptions& fit) {
    program
        .add_option("--network", fit.network,
                    "Encoding, network, loss and optimizer as JSON; default: a hash grid")
        ->group("Learning");
    CLI::Option* steps = addWhole(program, "--steps", fit.steps, "Steps to learn for", 1, 100000000)
                             ->group("Learning")
                             ->capture_default_str();
    addSeconds(program, "--time", fit.seconds, "To learn for, instead of a number of steps")
        ->excludes(steps)
        ->group("Learning");
    addWhole(program, "--batch", fit.batch, "Pixels of a step, a power of two", 256, 262144)
        ->group("Learning")
        ->capture_default_str();
    addWhole(program, "--seed", fit.seed, "Of the random numbers", 0, UINT32_MAX)
        ->group("Learning")
        ->capture_default_str();
}

void addOptions(CLI::App& program, Request& request) {
    program.set_version_flag("--version", "fit_image " IRRADIA_VERSION);
    program.add_option("picture", request.fit.picture, "PNG, JPEG or EXR; PSNR is of sRGB values in 0..1");
    addOutputs(program, request.fit);
    addLearning(program, request.fit);
    CLI::Option* make =
        addOutput(program, "--make-picture", request.makePicture, "Only paint a picture to learn, PNG")
            ->group("Test picture");
    program.add_option("--size", request.size, "Of that picture, WxH")
        ->needs(make)
        ->group("Test picture")
        ->capture_default_str();
    program.add_option("--device", request.fit.device.select, "Index, name, cpu or gpu")->group("Device");
    program.add_flag("--validation", request.fit.device.validation, "Vulkan's validation layers")
        ->group("Device");
    addProgressOption(program, request.fit.progress);
}

void run(const Request& request) {
    if (!request.makePicture.empty()) {
        requireEnding({"--make-picture", request.makePicture}, {".png"});
        requireWritable(request.makePicture);
        writePng(request.makePicture, makePicture(parseSize(request.size)));
        return;
    }
    if (request.fit.picture.empty() || request.fit.output.empty())
        fail(ExitCode::Usage, "a picture and -o OUT.exr are required, fit_image --help says more");
    catchInterrupts();
    fitImage(request.fit);
}

} // namespace
} // namespace irradia

int main(int argc, char** argv) {
    using namespace irradia;
    return runProgram("Learns a picture: place -> colour.", "fit_image", [&](CLI::App& program) {
        Request request;
        addOptions(program, request);
        program.parse(argc, argv);
        run(request);
    });
}
