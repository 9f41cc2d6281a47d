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

/// The source for pictures without a scene: optical flow, or the checked census where that was not built.
inline MotionSource best_picture_source() {
    return has_flow() ? MotionSource::flow : MotionSource::image;
}

}  // namespace aleph
