// A picture of radiance as a command line names it: FILE.exr, FILE.exr:LAYER or FILE.hdr.
#pragma once

#include "engine/image/image.h"

namespace irradia {

struct PictureName {
    std::filesystem::path file;
    std::string layer; // of an EXR: a layer, a part, or PART.LAYER; empty = R, G, B

    std::string extension() const; // in lower case
};

// A colon after ".exr" or ".hdr" begins a layer, unless there is a file of the whole name.
PictureName parsePictureName(const std::string& text);

// Its colours are rgb(name.layer). What does not end in .hdr is read as an EXR. Throws as readExr and
// readHdr.
LayeredImage readPicture(const PictureName& name);

} // namespace irradia
