#include "render/verify/picture_keeper.h"

#include <algorithm>

namespace aleph {

void PictureKeeper::keep(std::int64_t frame, Image<Rgb> picture) {
    if (std::ranges::find(pictures_, frame, &decltype(pictures_)::value_type::first) != pictures_.end()) return;
    bytes_ += picture.size() * sizeof(Rgb);
    pictures_.emplace_front(frame, std::move(picture));
    while (bytes_ > most_ && pictures_.size() > 1) {
        bytes_ -= pictures_.back().second.size() * sizeof(Rgb);
        pictures_.pop_back();
    }
}

const Image<Rgb>& PictureKeeper::find(std::int64_t frame) {
    const auto found = std::ranges::find(pictures_, frame, &decltype(pictures_)::value_type::first);
    if (found != pictures_.end()) {
        pictures_.splice(pictures_.begin(), pictures_, found);
    } else {
        keep(frame, make_(frame));
    }
    return pictures_.front().second;
}

}  // namespace aleph
