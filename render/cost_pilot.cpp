#include "render/cost_pilot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/pose/pose.h"
#include "render/key_moments.h"
#include "render/measure.h"
#include "render/sequence.h"

namespace aleph {

namespace {

/// What the clock shows beyond the stages belongs to pixels: buffers and their copies.
void add_frame(CostParts& parts, const FrameStatistics& frame, double clock) {
    const StageSeconds& seconds = frame.seconds;
    CostParts one;
    one.constant = seconds.pose + seconds.update;
    one.fill = seconds.fill;
    one.shade = seconds.shade;
    for (const MomentStatistics& moment : frame.moments) one.moments += moment.seconds;
    one.pixels = std::max(0.0, clock - one.sum());
    parts.constant += one.constant;
    parts.pixels += one.pixels;
    parts.fill += one.fill;
    parts.moments += one.moments;
    parts.shade += one.shade;
}

}  // namespace

std::vector<std::int64_t> choose_pilot_frames(const std::vector<int>& frames) {
    const std::size_t count = std::min<std::size_t>(3, frames.size());
    std::vector<std::int64_t> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(frames[(2 * i + 1) * frames.size() / (2 * count)]);
    return chosen;
}

double find_pilot_scale(int width) {
    return std::clamp(32.0 / width, 0.25, 1.0);
}

PictureSize scale_size(PictureSize size, double scale) {
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
    return {scaled(size.width), scaled(size.height)};
}

Pilot render_pilot(Scene scene, RenderSettings settings, const std::string& camera,
                   const std::vector<std::int64_t>& frames, double scale) {
    const PictureSize size = scale_size({settings.width, settings.height}, scale);
    settings.width = size.width;
    settings.height = size.height;
    scene.viewing.pixels_per_degree *= scale;
    Pilot pilot;
    pilot.run.error = settings.error;
    StageClock clock;
    Sequence sequence(std::move(scene), settings, camera);
    clock.add_to(pilot.run.start);
    std::set<std::int64_t> rendered;
    for (const std::int64_t frame : frames) {
        double seconds = 0.0;
        clock.add_to(seconds);
        seconds = 0.0;
        const FrameOutput output = sequence.render(frame);
        clock.add_to(seconds);
        add_frame(pilot.run.seconds, output.statistics, seconds);
        rendered.insert(output.statistics.copy_of.value_or(frame));
    }
    pilot.rendered = static_cast<int>(rendered.size());
    return pilot;
}

std::size_t count_moments(const Scene& scene, const RenderSettings& settings, const std::vector<std::int64_t>& frames) {
    if (settings.light_step == 0) return 0;
    const KeyMoments moments{frame_range(scene), scene.cuts, settings.light_step, {}};
    std::set<std::int64_t> read;
    for (const std::int64_t frame : frames) {
        const MomentPair pair = find_moments(moments, frame);
        read.insert({pair.before, pair.after});
    }
    return read.size();
}

CostRatios find_cost_ratios(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                            const std::vector<std::int64_t>& pilot_frames, int rendered, double scale) {
    const PictureSize small = scale_size({settings.width, settings.height}, scale);
    CostRatios ratios;
    ratios.pixels =
        static_cast<double>(settings.width) * settings.height / (static_cast<double>(small.width) * small.height);
    if (pilot_frames.size() > 1 && rendered == 1) return ratios;  // all frames are copies of one
    ratios.frames = static_cast<double>(frames.size()) / static_cast<double>(pilot_frames.size());
    const std::vector<std::int64_t> all(frames.begin(), frames.end());
    const std::size_t known = count_moments(scene, settings, pilot_frames);
    if (known > 0)
        ratios.moments = static_cast<double>(count_moments(scene, settings, all)) / static_cast<double>(known);
    return ratios;
}

}  // namespace aleph
