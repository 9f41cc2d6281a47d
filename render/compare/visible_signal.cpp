#include "render/compare/visible_signal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "perception/vision/castle.h"

namespace aleph {

namespace {

constexpr int most_frames = 15;  // of a window: reach is at most 7
constexpr float darkest = static_cast<float>(castle_min_luminance);

/// Weights of four samples around a place between the middle two (Catmull and Rom 1974).
std::array<float, 4> cubic_weights(float t) {
    return {t * (-0.5f + t * (1.0f - 0.5f * t)), 1.0f + t * t * (-2.5f + 1.5f * t), t * (0.5f + t * (2.0f - 1.5f * t)),
            t * t * (-0.5f + 0.5f * t)};
}

float sample(const Image<float>& image, float x, float y) {
    const float left = std::floor(x), top = std::floor(y);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    if (x == left && y == top && column >= 0 && row >= 0 && column < image.width && row < image.height)
        return image(column, row);
    const auto wx = cubic_weights(x - left), wy = cubic_weights(y - top);
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j) {
        const float* pixels = image.row(std::clamp(row - 1 + j, 0, image.height - 1));
        float line = 0.0f;
        for (int i = 0; i < 4; ++i) line += wx[i] * pixels[std::clamp(column - 1 + i, 0, image.width - 1)];
        sum += wy[j] * line;
    }
    return sum;
}

float nearest(const Image<float>& image, float x, float y) {
    return image(std::clamp(static_cast<int>(std::lround(x)), 0, image.width - 1),
                 std::clamp(static_cast<int>(std::lround(y)), 0, image.height - 1));
}

/// The errors of one pixel along its track: values[reach] is the current frame's.
struct Track {
    std::array<float, most_frames> values;
    std::array<bool, most_frames> known;
};

void fill_gaps(Track& track, int reach) {
    for (int k = 1; k <= reach; ++k) {
        for (const int side : {-1, 1}) {
            const int at = reach + side * k, mirror = reach - side * k;
            if (track.known[at]) continue;
            track.values[at] = track.known[mirror] ? track.values[mirror] : track.values[at - side];
        }
    }
}

}  // namespace

Image<float> image_velocity(const MotionMaps& motion, const SurfaceTracks& tracks, const ViewingSettings& settings) {
    const TrackImage* const before = tracks.before.empty() ? nullptr : &tracks.before.front();
    const double scale = settings.frame_rate.per_second() / settings.viewing.pixels_per_degree;
    Image<float> velocity(motion.u.width, motion.u.height);
    for (int y = 0; y < velocity.height; ++y) {
        for (int x = 0; x < velocity.width; ++x) {
            const std::size_t i = velocity.index(x, y);
            double pixels = 0.0;
            if (moves_as_told(motion.valid.pixels[i])) {
                pixels = std::hypot(motion.u.pixels[i], motion.v.pixels[i]);
            } else if (before && !std::isnan(before->pixels[i].x)) {
                pixels = std::hypot(before->pixels[i].x - static_cast<float>(x),
                                    before->pixels[i].y - static_cast<float>(y));
            }
            velocity.pixels[i] = std::isfinite(pixels) ? static_cast<float>(scale * pixels) : 0.0f;
        }
    }
    return velocity;
}

SignalParts filter_band(const BandWindow& window, const VisibleFilter& filter, const Image<float>& velocity) {
    const Image<float>&current = *window.current.error, &background = *window.current.background;
    const int width = current.width, height = current.height, reach = window.reach;
    const float scale = std::ldexp(1.0f, -window.level);
    SignalParts parts{Image<float>(width, height), Image<float>(width, height), Image<float>(width, height)};
    const auto look_up = [&](Track& track, int side, const std::vector<BandFrame>& frames,
                             const std::vector<TrackImage>& tracks, std::size_t pixel, float adapted) {
        for (int k = 1; k <= reach; ++k) {
            const auto of = static_cast<std::size_t>(k - 1);
            const int at = reach + side * k;
            track.known[at] = of < frames.size() && !std::isnan(tracks[of].pixels[pixel].x);
            if (!track.known[at]) continue;
            const glm::vec2 p = tracks[of].pixels[pixel] * scale;
            const float there = std::max(adapted, nearest(*frames[of].background, p.x, p.y));
            track.values[at] = sample(*frames[of].error, p.x, p.y) * (adapted / there);
        }
    };
    parallel_rows(height, 8, [&](int begin, int end) {
        Track track{};
        std::array<float, most_frames> weights{};
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t pixel = velocity.index(x << window.level, y << window.level),
                                  i = background.index(x, y);
                const float adapted = std::max(darkest, background.pixels[i]);
                track.values[reach] = current.pixels[i];
                look_up(track, 1, window.next, window.tracks.after, pixel, adapted);
                look_up(track, -1, window.previous, window.tracks.before, pixel, adapted);
                fill_gaps(track, reach);
                const float sensitivity = filter.evaluate(adapted, velocity.pixels[pixel], weights.data());
                float all = weights[0] * track.values[reach], mean = track.values[reach];
                for (int k = 1; k <= reach; ++k) {
                    const float pair = track.values[reach - k] + track.values[reach + k];
                    all += weights[k] * pair;
                    mean += pair;
                }
                const float lasting = sensitivity * mean / static_cast<float>(2 * reach + 1);
                parts.lasting.pixels[i] = lasting / adapted;
                parts.flicker.pixels[i] = (all - lasting) / adapted;
                parts.sensitivity.pixels[i] = sensitivity;
            }
        }
    });
    return parts;
}

Image<float> masking_elevation(const Image<float>& masker, const Image<float>& background,
                               const Image<float>& sensitivity, int channel) {
    return map_pixels(
        [&](float amplitude, float adapted, float sensitive) {
            return contrast_masking(sensitive * amplitude / std::max(darkest, adapted), channel);
        },
        masker, background, sensitivity);
}

void add_squares(const SignalParts& parts, const Image<float>& elevation, const BandShape& shape,
                 const std::vector<LevelSize>& sizes, float factor, VisibleMaps& sums) {
    const auto add_to = [&](Image<float>& sum, const Image<float>& signal) {
        Image<float> squares = local_amplitude(signal, shape);
        for (std::size_t i = 0; i < squares.size(); ++i) {
            const float units = squares.pixels[i] / elevation.pixels[i];
            squares.pixels[i] = units * units;
        }
        const Image<float> full = expand_to_level(squares, sizes, shape.level, 0);
        for (std::size_t i = 0; i < sum.size(); ++i) sum.pixels[i] += factor * full.pixels[i];
    };
    Image<float> all = parts.lasting;
    for (std::size_t i = 0; i < all.size(); ++i) all.pixels[i] += parts.flicker.pixels[i];
    add_to(sums.seen, all);
    add_to(sums.flicker, parts.flicker);
    add_to(sums.lasting, parts.lasting);
}

}  // namespace aleph
