#include "scenes/studies/threshold_maps.h"

#include <algorithm>
#include <array>

#include "render/output/frame_files.h"

namespace aleph {

std::vector<ChannelImage> compute_threshold_maps(const Scene& scene, RenderSettings settings, FrameRange range) {
    constexpr std::array kept = {"forward.u",  "forward.v",   "motion.valid",
                                 "objectId.X", "threshold.Y", "threshold.flicker"};
    settings.perception.guide = Guide::saliency;
    Sequence sequence(scene, settings);
    FrameRequest request;
    request.frame = false;
    request.maps = true;
    std::vector<ChannelImage> maps;
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        maps.push_back(
            make_frame_image(sequence.render(frame, request), true, sequence.scene(), settings, sequence.exposure()));
        std::erase_if(maps.back().channels,
                      [&](const Channel& channel) { return std::ranges::find(kept, channel.name) == kept.end(); });
    }
    return maps;
}

}  // namespace aleph
