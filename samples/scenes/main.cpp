// make_scenes OUTDIR: writes the project's own scenes. Equal programs write equal bytes.
#include "engine/error.h"
#include "scenes.h"

int main(int argc, char** argv) {
    using namespace irradia;
    if (argc != 2) {
        fmt::print(stderr, "usage: make_scenes OUTDIR\n");
        return static_cast<int>(ExitCode::Usage);
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        scenes::writeCornellBox(folder);
        scenes::writeDoorRoom(folder);
        scenes::writeGlossyRoom(folder);
        scenes::writeLampGallery(folder);
        scenes::writeInterior(folder);
        scenes::writeFurnaceSphere(folder);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "make_scenes: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_scenes: {}\n", error.what());
        return static_cast<int>(ExitCode::Io);
    }
}
