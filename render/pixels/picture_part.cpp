#include "render/pixels/picture_part.h"

#include <algorithm>

namespace aleph {

PicturePart choose_part(int width, int height, int every, int block) {
    constexpr int lattice_step = 3;  // blocks by which each row is shifted against the one above
    PicturePart part(width, height, std::uint8_t{0});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) part(x, y) = (x / block + lattice_step * (y / block)) % every == every / 2;
    }
    return part;
}

void mark_area(PicturePart& part, const PictureArea& area, int around) {
    for (int y = std::max(0, area.y - around); y < std::min(part.height, area.y + area.height + around); ++y) {
        for (int x = std::max(0, area.x - around); x < std::min(part.width, area.x + area.width + around); ++x)
            part(x, y) = 1;
    }
}

double find_share(const PicturePart& part) {
    const auto pixels = std::ranges::count(part.pixels, std::uint8_t{1});
    return static_cast<double>(pixels) / static_cast<double>(part.size());
}

void forget_others(const PicturePart& part, Image<Hit>& hits) {
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (part.pixels[i] == 0) hits.pixels[i].instance = no_index;
    }
}

}  // namespace aleph
