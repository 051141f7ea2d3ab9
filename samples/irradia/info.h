// The sheets of `irradia info`, one for each kind of file.
#pragma once

#include <filesystem>

namespace irradia {

void printSceneInfo(const std::filesystem::path& file, bool asJson);
void printExrInfo(const std::filesystem::path& file, bool asJson);
void printHdrInfo(const std::filesystem::path& file, bool asJson);
void printScreenPictureInfo(const std::filesystem::path& file, bool asJson); // PNG, JPEG, WebP
void printModelInfo(const std::filesystem::path& file, bool asJson);

} // namespace irradia
