#pragma once
// The fingerprints of frames that a command makes.

#include <functional>
#include <string>

#include "render/cli/scene_options.h"
#include "render/frame/frame_output.h"

namespace aleph {

struct FramePrints {
    std::string identity;                      ///< what all files have in common
    std::function<std::string(int frame)> of;  ///< of a frame's file
};

/// Of frames of a scene, or of their maps.
FramePrints fingerprint_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request);

/// What a frame's file holds, for its fingerprint.
std::string describe_content(const SceneOptions& options, const FrameRequest& request);

}  // namespace aleph
