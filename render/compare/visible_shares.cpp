#include "render/compare/visible_shares.h"

#include <algorithm>

#include "engine/base/errors.h"
#include "render/compare/compare_luminance.h"

namespace aleph {

void VisibleCount::add(const VisibleMaps& maps, const Image<float>* saliency) {
    const auto count = [](const Image<float>& units) {
        return static_cast<std::size_t>(std::ranges::count_if(units.pixels, [](float value) { return value >= 1.0f; }));
    };
    pixels_ += maps.seen.size();
    seen_ += count(maps.seen);
    flicker_ += count(maps.flicker);
    lasting_ += count(maps.lasting);
    has_saliency_ = has_saliency_ && saliency && same_size(*saliency, maps.seen);
    if (!has_saliency_) return;
    for (std::size_t i = 0; i < maps.seen.size(); ++i) {
        looked_ += saliency->pixels[i];
        if (maps.seen.pixels[i] >= 1.0f) noticed_ += saliency->pixels[i];
    }
}

VisibleShares VisibleCount::shares() const {
    if (pixels_ == 0) return {};
    const auto percent = [&](std::size_t count) { return 100.0 * static_cast<double>(count) / static_cast<double>(pixels_); };
    VisibleShares shares{percent(seen_), percent(flicker_), percent(lasting_)};
    if (has_saliency_ && looked_ > 0.0) shares.noticed = 100.0 * noticed_ / looked_;
    return shares;
}

PicturePair read_pair(const ChannelImage& a, const ChannelImage& b) {
    PicturePair pair{linear_colour(a), linear_colour(b), read_noise(b)};
    if (pair.picture.empty() || pair.reference.empty())
        throw InputError("", "colour", "needs pictures with R, G and B");
    return pair;
}

VisibleMaps compare_stills(const ChannelImage& a, const ChannelImage& b, const ChannelImage& maps) {
    VisibleDifference difference(read_viewing(maps));
    difference.add(0, read_pair(a, b), read_motion(maps));
    return std::move(difference.finish().front());
}

}  // namespace aleph
