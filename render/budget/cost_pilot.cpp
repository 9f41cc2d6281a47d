#include "render/budget/cost_pilot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "render/frame/sequence.h"
#include "render/settings/measure.h"
#include "render/time/lighting_keyframes.h"

namespace aleph {

namespace {

constexpr double light_scale = 0.25;  // of the smaller picture
constexpr int least_width = 32;       // pixels, of that, unless the frame is less than twice as wide
constexpr int part_block = 4;         // pixels: decisions read the pixels around
constexpr int blocks_of_all = 75;     // a picture of fewer than four times as many is measured whole
constexpr int most_every = 8;
constexpr double light_growth = 4.0;  // seconds, from one small picture to the next
constexpr double part_growth = 2.0;   // seconds, from one error to the next

/// How many lighting keyframes the frames read, jumps of the light not counted.
/// @param scene  of the Sequence, whose cuts include changes of the camera
std::size_t count_keyframes(const Scene& scene, const RenderSettings& settings,
                            const std::vector<std::int64_t>& frames) {
    if (!reads_keyframes(settings)) return 0;
    const LightingKeyframes keyframes{frame_range(scene), scene.film.cuts, settings.cache.light_step, {}};
    std::set<std::int64_t> read;
    for (const std::int64_t frame : frames) {
        const KeyframePair pair = find_keyframes(keyframes, frame);
        read.insert({pair.before, pair.after});
    }
    return read.size();
}

/// Times light in a picture of this scale, in which angles stay the same, and so velocities.
LightSeconds time_light(const PilotRequest& request, double scale) {
    Scene scene = request.scene;
    RenderSettings settings = request.settings.front();
    const PictureSize full{settings.picture.width, settings.picture.height}, size = scale_size(full, scale);
    settings.picture.width = size.width;
    settings.picture.height = size.height;
    scene.film.viewing.pixels_per_degree *= scale;
    Sequence sequence(std::move(scene), settings, request.camera);
    LightSeconds seconds{.pixels = static_cast<double>(full.width) * full.height /
                                   (static_cast<double>(size.width) * size.height)};
    for (const std::int64_t frame : request.frames) {
        const LightTime time = sequence.time_light(frame);
        seconds.fill += time.fill;
        seconds.keyframes += time.keyframes;
    }
    return seconds;
}

/// One block of so many: all of a small picture, an eighth from 320x240 on.
int choose_every(const RenderSettings& settings) {
    const int blocks = settings.picture.width * settings.picture.height / (part_block * part_block);
    int every = 1;
    while (every < most_every && blocks >= blocks_of_all * 4 * every * every) every *= 2;
    return every;
}

void time_parts(const PilotRequest& request, Sequence& sequence, Pilot& pilot) {
    const PictureSettings& picture = request.settings.front().picture;
    const PicturePart part =
        choose_part(picture.width, picture.height, choose_every(request.settings.front()), part_block);
    pilot.seconds.share = find_share(part);
    // After an error of the first frame: is there time for the next one, in all frames?
    const auto go_on = [&](const PartTimes& now) {
        if (now.parts.size() < 2) return true;
        const auto frames = static_cast<double>(request.frames.size());
        PilotSeconds expected = pilot.seconds;
        expected.before = frames * now.before;
        double next = (frames - 1.0) * now.before;
        for (std::size_t i = 0; i < now.parts.size(); ++i) {
            const PartTime& done = now.parts[i];
            expected.parts.push_back({request.settings[i].error, frames * done.fill, frames * done.shade});
            next += (frames - 1.0) * (done.fill + done.shade);
        }
        const PartTime& last = now.parts.back();
        return request.go_on(expected, next + part_growth * frames * (last.fill + last.shade));
    };
    std::set<std::int64_t> rendered;
    for (const std::int64_t frame : request.frames) {
        const bool first = rendered.empty();
        const std::size_t count = first ? request.settings.size() : pilot.seconds.parts.size();
        const PartTimes times = sequence.time_part(frame, part, {request.settings.data(), count},
                                                   [&](const PartTimes& now) { return !first || go_on(now); });
        pilot.seconds.before += times.before;
        pilot.seconds.parts.resize(times.parts.size());
        for (std::size_t i = 0; i < times.parts.size(); ++i) {
            PartSeconds& sum = pilot.seconds.parts[i];
            sum.error = request.settings[i].error;
            sum.fill += times.parts[i].fill;
            sum.shade += times.parts[i].shade;
        }
        rendered.insert(times.frame);
    }
    pilot.rendered = static_cast<int>(rendered.size());
}

}  // namespace

std::vector<std::int64_t> choose_pilot_frames(const std::vector<int>& frames) {
    const std::size_t count = std::min<std::size_t>(3, frames.size());
    std::vector<std::int64_t> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(frames[(2 * i + 1) * frames.size() / (2 * count)]);
    return chosen;
}

PictureSize scale_size(PictureSize size, double scale) {
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(scale * side))); };
    return {scaled(size.width), scaled(size.height)};
}

Pilot run_pilot(const PilotRequest& request) {
    Pilot pilot;
    const RenderSettings& settings = request.settings.front();
    const auto frames = static_cast<double>(request.frames.size());
    pilot.seconds.keyframes = static_cast<double>(count_keyframes(request.scene, settings, request.frames)) / frames;
    StageClock clock;
    // Light that does not grow with the picture, of further bounces, is most of that of a few pixels. So small pictures
    // are larger parts of it, the larger one first: it tells more, and takes hardly longer. One always has four times
    // the pixels of the other, so that their growth is not lost in noise.
    const double small = std::clamp(least_width / (1.0 * settings.picture.width), light_scale, 0.5);
    const bool tiny = small > light_scale;
    for (const bool first : {true, false}) {
        double last = 0.0;
        pilot.seconds.light.push_back(time_light(request, first == tiny ? 2.0 * small : small));
        clock.add_to(last);
        if (first && !request.go_on(pilot.seconds, tiny ? last : light_growth * last)) break;
    }
    Sequence sequence(request.scene, settings, request.camera);
    clock.add_to(pilot.seconds.start);
    time_parts(request, sequence, pilot);
    return pilot;
}

CostRatios find_cost_ratios(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                            const std::vector<std::int64_t>& pilot_frames, int rendered) {
    CostRatios ratios;
    if (pilot_frames.size() > 1 && rendered == 1) return ratios;  // all frames are copies of one
    ratios.frames = static_cast<double>(frames.size()) / static_cast<double>(pilot_frames.size());
    const std::vector<std::int64_t> all(frames.begin(), frames.end());
    const std::size_t known = count_keyframes(scene, settings, pilot_frames);
    if (known > 0)
        ratios.keyframes = static_cast<double>(count_keyframes(scene, settings, all)) / static_cast<double>(known);
    return ratios;
}

}  // namespace aleph
