#include "render/verify/probe_reference.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/base/pixel_loops.h"
#include "engine/base/pyramid.h"
#include "engine/base/sampling.h"

namespace aleph {

namespace {

constexpr int most_side = 16;          // pixels, of a block
constexpr double root = 1.2207440846;  // of x^4 = x + 1

/// Where the sequence is along an axis, in [0, 1).
double at_axis(std::size_t number, int axis) {
    const double at = 0.5 + static_cast<double>(number + 1) * std::pow(root, -(axis + 1));
    return at - std::floor(at);
}

/// One of `count` parts, by a place in [0, 1).
int part_at(double place, int count) {
    return std::min(static_cast<int>(place * count), count - 1);
}

struct Span {
    int first, size;
};

Span choose_span(double place, int length) {
    const int count = (length + most_side - 1) / most_side, i = part_at(place, count);
    const int first = i * length / count;
    return {first, (i + 1) * length / count - first};
}

/// Red, green and blue times weights, and the weights.
using Weighted = std::array<Image<float>, 4>;
constexpr std::size_t weights_at = 3;

/// Fills what weighs less than 1 from the coarser level.
void push(const Weighted& coarse, Weighted& fine) {
    const Image<float>& weights = fine[weights_at];
    for (std::size_t c = 0; c < 3; ++c) {
        const Image<float> beyond = expand(coarse[c], {weights.width, weights.height});
        for (std::size_t i = 0; i < weights.size(); ++i)
            fine[c].pixels[i] += (1.0f - weights.pixels[i]) * beyond.pixels[i];
    }
}

/// The next coarser level, with weights of at most 1: what is known well keeps its value.
Weighted pull(const Weighted& fine) {
    Weighted level{reduce(fine[0]), reduce(fine[1]), reduce(fine[2]), reduce(fine[weights_at])};
    for (std::size_t i = 0; i < level[weights_at].size(); ++i) {
        float& weight = level[weights_at].pixels[i];
        const float full = std::min(1.0f, 4.0f * weight);
        const float scale = weight > 0.0f ? full / weight : 0.0f;
        for (std::size_t c = 0; c < 3; ++c) level[c].pixels[i] *= scale;
        weight = full;
    }
    return level;
}

constexpr std::uint64_t reference_seed = 0x7665726966790000ull;  // keeps references apart from all that they judge
constexpr int margin = 8;       // pixels around a block that its signals are filtered with
constexpr int track_reach = 1;  // pixels around a tracked place
constexpr int context = 40;     // pixels around all parts
constexpr int alignment = 16;   // pixels, so that coarse levels lie as in the whole picture

MotionMaps crop_maps(const MotionMaps& maps, const PictureArea& area) {
    return {crop(maps.u, area), crop(maps.v, area), crop(maps.valid, area), crop(maps.object, area)};
}

PicturePart tracked_part(const PicturePart& part, const TrackImage& track) {
    PicturePart out(part.width, part.height, std::uint8_t{0});
    for (std::size_t i = 0; i < part.size(); ++i) {
        const glm::vec2 p = track.pixels[i];
        if (part.pixels[i] == 0 || std::isnan(p.x)) continue;
        mark_area(out, {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)), 1, 1}, track_reach);
    }
    return out;
}

PictureArea find_area(const std::vector<ProbeFrame>& frames, int width, int height) {
    int left = width, top = height, right = 0, bottom = 0;
    for (const ProbeFrame& each : frames) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (each.part(x, y) == 0) continue;
                left = std::min(left, x), right = std::max(right, x + 1);
                top = std::min(top, y), bottom = std::max(bottom, y + 1);
            }
        }
    }
    left = std::max(0, left - context) / alignment * alignment;
    top = std::max(0, top - context) / alignment * alignment;
    return {left, top, std::min(width, right + context) - left, std::min(height, bottom + context) - top};
}

std::uint32_t half_seed(std::int64_t frame, int round, int half) {
    const auto place = static_cast<std::uint64_t>(frame) << 16 | static_cast<std::uint64_t>(2 * round + half);
    return static_cast<std::uint32_t>(mix_bits(mix_bits(reference_seed) + place) >> 32);
}

/// Takes a mean of `added` samples into one of `count`.
void add_to_mean(Image<Rgb>& mean, int count, const Image<Rgb>& picture, int added) {
    if (mean.empty()) mean = Image<Rgb>(picture.width, picture.height, Rgb(0.0f));
    const float weight = static_cast<float>(added) / static_cast<float>(count + added);
    for (std::size_t i = 0; i < mean.size(); ++i) mean.pixels[i] += weight * (picture.pixels[i] - mean.pixels[i]);
}

}  // namespace

ProbePlace place_probe(std::size_t number, std::span<const std::int64_t> frames, int width, int height) {
    const Span x = choose_span(at_axis(number, 1), width), y = choose_span(at_axis(number, 2), height);
    const int frame = part_at(at_axis(number, 0), static_cast<int>(frames.size()));
    return {frames[static_cast<std::size_t>(frame)], {x.first, y.first, x.size, y.size}};
}

Image<Rgb> continue_error(const Image<Rgb>& error, const PicturePart& part) {
    const Image<float> empty(error.width, error.height);
    std::vector<Weighted> levels{{empty, empty, empty, empty}};
    bool any = false;
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (part.pixels[i] == 0 || !is_finite(error.pixels[i])) continue;
        any = true;
        levels[0][weights_at].pixels[i] = 1.0f;
        for (int c = 0; c < 3; ++c) levels[0][static_cast<std::size_t>(c)].pixels[i] = error.pixels[i][c];
    }
    Image<Rgb> out(error.width, error.height, Rgb(0.0f));
    if (!any) return out;
    while (levels.back()[weights_at].size() > 1) levels.push_back(pull(levels.back()));
    Weighted& top = levels.back();  // one pixel, which may weigh little
    for (std::size_t c = 0; c < 3; ++c) top[c].pixels[0] /= std::max(top[weights_at].pixels[0], 1e-6f);
    for (std::size_t i = levels.size() - 1; i-- > 0;) push(levels[i + 1], levels[i]);
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels[i] = {levels[0][0].pixels[i], levels[0][1].pixels[i], levels[0][2].pixels[i]};
    return out;
}

MotionMaps read_maps(const FrameOutput& output) {
    const MotionField& field = output.motion;
    return {map_pixels([](const glm::dvec2& way) { return static_cast<float>(way.x); }, field.displacement),
            map_pixels([](const glm::dvec2& way) { return static_cast<float>(-way.y); }, field.displacement),
            map_pixels([](MotionValidity code) { return static_cast<float>(static_cast<int>(code)); }, field.validity),
            map_pixels([](const Hit& hit) { return static_cast<float>(hit.instance); }, output.hits)};
}

std::vector<std::int64_t> list_window(std::int64_t frame, int reach, const FrameRange& range,
                                      std::span<const std::int64_t> cuts) {
    const auto is_cut = [&](std::int64_t at) { return std::ranges::find(cuts, at) != cuts.end(); };
    if (frame < range.first || frame > range.last) return {frame};
    std::int64_t first = frame, last = frame;
    while (first > frame - reach && first > range.first && !is_cut(first)) --first;
    while (last < frame + reach && last < range.last && !is_cut(last + 1)) ++last;
    std::vector<std::int64_t> window;
    for (std::int64_t at = first; at <= last; ++at) window.push_back(at);
    return window;
}

ProbeWindow find_probe_window(const ProbePlace& place, Sequence& sequence) {
    ProbeWindow window;
    const Scene& scene = sequence.scene();
    std::size_t own = 0;
    for (const std::int64_t frame :
         list_window(place.frame, filter_reach(scene.film.frame_rate), sequence.range(), scene.film.cuts)) {
        if (frame == place.frame) own = window.frames.size();
        window.frames.push_back({frame, read_maps(sequence.find_motion(frame)), {}, {}});
    }
    const int width = window.frames[own].motion.u.width, height = window.frames[own].motion.u.height;
    std::vector<const MotionMaps*> motion;
    for (const ProbeFrame& each : window.frames) motion.push_back(&each.motion);
    const auto [after, before] = track_surfaces(motion, own);
    PicturePart part(width, height, std::uint8_t{0});
    mark_area(part, place.block, margin);
    window.frames[own].part = part;
    for (std::size_t k = 0; k < after.size(); ++k) window.frames[own + 1 + k].part = tracked_part(part, after[k]);
    for (std::size_t k = 0; k < before.size(); ++k) window.frames[own - 1 - k].part = tracked_part(part, before[k]);
    window.area = find_area(window.frames, width, height);
    window.block = place.block;
    window.block.x -= window.area.x;
    window.block.y -= window.area.y;
    for (ProbeFrame& each : window.frames) each.motion = crop_maps(each.motion, window.area);
    return window;
}

void add_reference_samples(ProbeWindow& window, int round, int samples, Sequence& sequence,
                           const FrameProgress& progress) {
    for (ProbeFrame& each : window.frames) {
        // Where samples lie in a pixel may depend on their number alone. Halves of equal numbers would make the same
        // error at an edge, which their difference does not tell.
        const PartSamples pictures[] = {{half_seed(each.frame, round, 0), samples},
                                        {half_seed(each.frame, round, 1), samples + 1}};
        const std::vector<Image<Rgb>> made = sequence.render_part(each.frame, each.part, pictures, progress);
        for (std::size_t half = 0; half < 2; ++half)
            add_to_mean(each.halves[half], each.samples / 2, crop(made[half], window.area), samples);
        each.samples += 2 * samples;
    }
}

PicturePair make_probe_pair(const ProbeFrame& frame, const PictureArea& area, const Image<Rgb>& picture) {
    PicturePair pair{crop(picture, area), frame.halves[0], frame.halves[0]};
    for (std::size_t i = 0; i < pair.reference.size(); ++i) {
        pair.reference.pixels[i] = 0.5f * (frame.halves[0].pixels[i] + frame.halves[1].pixels[i]);
        pair.noise.pixels[i] = 0.5f * (frame.halves[0].pixels[i] - frame.halves[1].pixels[i]);
    }
    const PicturePart part = crop(frame.part, area);
    const Image<Rgb> error = continue_error(map_pixels(std::minus<Rgb>(), pair.picture, pair.reference), part);
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (part.pixels[i] != 0) continue;
        pair.reference.pixels[i] = glm::max(pair.picture.pixels[i] - error.pixels[i], Rgb(0.0f));
    }
    return pair;
}

}  // namespace aleph
