#include "render/cli/frame_prints.h"

#include <fmt/format.h>

#include "engine/pose/pose.h"
#include "engine/scene/scene_hash.h"
#include "render/settings/fingerprint.h"

namespace aleph {

std::string describe_content(const SceneOptions& options, const FrameRequest& request) {
    return fmt::format("{}{}{}", request.frame ? "picture " : "", request.maps ? "maps " : "",
                       options.importance ? "importance" : "");
}

FramePrints fingerprint_frames(const PreparedScene& prepared, const SceneOptions& options,
                               const FrameRequest& request) {
    const Fingerprint print =
        make_fingerprint(prepared.scene, prepared.settings, list_camera_shots(prepared.scene, options.camera));
    const std::string names = hash_names(prepared.scene), content = describe_content(options, request);
    return {hash_bytes(fmt::format("{}\n{}\n{}", format_fingerprint(print), names, content)),
            [=](int frame) { return frame_fingerprint(print, names, content, frame); }};
}

}  // namespace aleph
