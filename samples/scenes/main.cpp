// make_scenes OUTDIR: writes the project's own scenes. Equal programs write equal bytes.
#include "engine/error.h"
#include "samples/support/program.h"
#include "scenes.h"

namespace irradia {
namespace {

void makeScenes(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    scenes::writeCornellBox(folder);
    scenes::writeDoorRoom(folder);
    scenes::writeGlossyRoom(folder);
    scenes::writeLampGallery(folder);
    scenes::writeMixedLamps(folder);
    scenes::writeInterior(folder);
    scenes::writeGreenhouse(folder);
    scenes::writeFurnaceSphere(folder);
}

} // namespace
} // namespace irradia

int main(int argc, char** argv) {
    using namespace irradia;
    return runProgram("Writes the project's own scenes.", "make_scenes", [&](CLI::App& program) {
        std::string folder;
        program.add_option("OUTDIR", folder, "Folder for them, made where it is missing")->required();
        program.parse(argc, argv);
        if (folder.empty()) fail(ExitCode::Usage, "OUTDIR: the folder's name is empty");
        makeScenes(folder);
    });
}
