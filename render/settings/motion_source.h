#pragma once
// Sources of motion that compare pictures.

#include <optional>

#include "motion/picture_motion.h"
#include "render/settings/settings.h"

namespace aleph {

/// The search of a source that compares pictures; nothing for one that reads the scene.
inline std::optional<PictureSearch> picture_search(MotionSource source) {
    switch (source) {
        case MotionSource::census:
            return PictureSearch::census;
        case MotionSource::image:
            return PictureSearch::checked;
        case MotionSource::flow:
            return PictureSearch::flow;
        default:
            return std::nullopt;
    }
}

/// The source for pictures without a scene: the given one if it compares pictures, else optical flow, or the checked
/// census where that was not built.
inline MotionSource source_for_pictures(MotionSource given) {
    if (picture_search(given)) return given;
    return has_flow() ? MotionSource::flow : MotionSource::image;
}

}  // namespace aleph
