// The project's own scenes: one file each, written into `folder` under the name stated there.
#pragma once

#include "glb_writer.h"

#include <filesystem>

namespace irradia::scenes {

void writeCornellBox(const std::filesystem::path& folder);    // cornell-box.glb
void writeDoorRoom(const std::filesystem::path& folder);      // door-room.glb
void writeGlossyRoom(const std::filesystem::path& folder);    // glossy-room.glb, .json, -sky.exr
void writeLampGallery(const std::filesystem::path& folder);   // lamp-gallery.glb
void writeMixedLamps(const std::filesystem::path& folder);    // mixed-lamps.glb, mixed-lamp.glb
void writeInterior(const std::filesystem::path& folder);      // interior.glb
void writeGreenhouse(const std::filesystem::path& folder);    // greenhouse.glb, .json
void writeFurnaceSphere(const std::filesystem::path& folder); // furnace-sphere.glb

} // namespace irradia::scenes
