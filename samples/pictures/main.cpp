// pictures: puts EXR pictures into one, side by side for the eye or as their mean for a reference; and tells
// how much two differ.
#include "samples/pictures/pictures.h"
#include "samples/support/numbers.h"
#include "samples/support/outputs.h"
#include "samples/support/program.h"
#include "samples/support/standard_streams.h"

namespace irradia {
namespace {

struct Request {
    std::vector<std::string> pictures;
    std::string output;
    uint32_t scale = 1;
};

std::vector<LayeredImage> readAll(const std::vector<std::string>& files) {
    std::vector<LayeredImage> pictures;
    for (const std::string& file : files) pictures.push_back(readExr(file));
    return pictures;
}

// Refuses what would be lost, or lost time, before anything is read.
void checkOutput(const Request& request, const char* ending) {
    const NamedFile output{"-o", request.output};
    requireEnding(output, {ending});
    std::vector<NamedFile> inputs;
    for (const std::string& file : request.pictures) inputs.push_back({"a picture that is read", file});
    checkOutputs({output}, inputs);
}

CLI::App* addVerb(CLI::App& program, const char* name, const char* what, const char* output,
                  Request& request) {
    CLI::App* verb = program.add_subcommand(name, what);
    verb->add_option("pictures", request.pictures, "EXR files of one size")->required();
    addOutput(*verb, "-o,--output", request.output, output)->required();
    return verb;
}

void addRow(CLI::App& program, Request& request) {
    CLI::App* row = addVerb(program, "row", "Side by side, as a screen shows them", "PNG file", request);
    addWhole(*row, "--scale", request.scale, "Pixels become so many wide and high", 1, 16)
        ->capture_default_str();
    row->callback([&request] {
        checkOutput(request, ".png");
        writePng(request.output, pictureRow(readAll(request.pictures), static_cast<int>(request.scale)));
    });
}

void addMean(CLI::App& program, Request& request) {
    CLI::App* mean = addVerb(program, "mean", "The mean of R, G and B, each picture counting alike",
                             "EXR file, half floats", request);
    mean->callback([&request] {
        checkOutput(request, ".exr");
        writeHalfExr(request.output, meanPicture(readAll(request.pictures)));
    });
}

void addNoise(CLI::App& program, Request& request) {
    CLI::App* verb = program.add_subcommand(
        "noise", "Variance of two pictures that differ in their seed alone, relative to a third: without the "
                 "largest hundredth of the pixels, and of all");
    verb->add_option("pictures", request.pictures, "Two EXR files and what they show, all of one size")
        ->required()
        ->expected(3);
    verb->callback([&request] {
        const std::vector<LayeredImage> pictures = readAll(request.pictures);
        const Noise noise = noiseOf(pictures[0], pictures[1], pictures[2]);
        printResult("{:.6g} {:.6g}\n", noise.most, noise.all);
    });
}

} // namespace
} // namespace irradia

int main(int argc, char** argv) {
    using namespace irradia;
    return runProgram("Puts EXR pictures into one.", "pictures", [&](CLI::App& program) {
        Request request;
        program.set_version_flag("--version", "pictures " IRRADIA_VERSION);
        program.require_subcommand(1);
        addRow(program, request);
        addMean(program, request);
        addNoise(program, request);
        program.parse(argc, argv);
    });
}
