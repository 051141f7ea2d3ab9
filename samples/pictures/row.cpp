#include "samples/pictures/pictures.h"

#include "engine/image/display.h"
#include "samples/pictures/same_size.h"
#include <algorithm>

namespace irradia {
namespace {

constexpr int kGutter = 8; // pixels of the row
constexpr uint8_t kWhite = 255;

// Every pixel scale x scale times, with its upper left corner at column `left` of the row.
void place(const Rgba8Image& picture, int scale, int left, Rgba8Image& row) {
    for (int y = 0; y < row.height; ++y)
        for (int x = 0; x < picture.width * scale; ++x) {
            const auto from = picture.pixels.begin() + 4 * (ptrdiff_t{y / scale} * picture.width + x / scale);
            std::copy_n(from, 4, row.pixels.begin() + 4 * (ptrdiff_t{y} * row.width + left + x));
        }
}

} // namespace

Rgba8Image pictureRow(std::span<const LayeredImage> pictures, int scale) {
    requireSameSize(pictures);
    const int count = static_cast<int>(pictures.size());
    const int width = pictures[0].width * scale;
    Rgba8Image row{count * width + (count - 1) * kGutter, pictures[0].height * scale, {}};
    row.pixels.assign(size_t{4} * static_cast<size_t>(row.width) * static_cast<size_t>(row.height), kWhite);
    for (int i = 0; i < count; ++i) {
        const LayeredImage& picture = pictures[static_cast<size_t>(i)];
        place(toDisplay(picture.width, picture.height, picture.rgb()), scale, i * (width + kGutter), row);
    }
    return row;
}

} // namespace irradia
