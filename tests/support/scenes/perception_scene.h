#pragma once
// A synthetic frame: a shaded, textured room under a slow pan, and objects that move, one of them fast. Any size; the
// same bits on every call.

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/sampling.h"
#include "perception/perception.h"
#include "perception/vision/tvi.h"
#include "perception/vision/vision_model.h"
#include "tests/support/all_pixels.h"

namespace aleph {

inline double mean_of(const Image<float>& image) {
    double sum = 0.0;
    for (const float v : image.pixels) sum += v;
    return sum / static_cast<double>(image.size());
}

inline Image<float> checker(int width, int height) {
    Image<float> image(width, height);
    for (const auto [x, y] : all_pixels(width, height)) image(x, y) = static_cast<float>((x + y) % 2);
    return image;
}

/// Correlation of two maps over the pixels further than `radius` from a place.
inline double correlation(const Image<float>& a, const Image<float>& b, const glm::ivec2& place = {},
                          double radius = -1.0) {
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (const auto [x, y] : all_pixels(a)) {
        if (std::hypot(x - place.x, y - place.y) <= radius) continue;
        const double p = a(x, y), q = b(x, y);
        n += 1, sa += p, sb += q, saa += p * p, sbb += q * q, sab += p * q;
    }
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

struct SyntheticFrame {
    Image<Rgb> estimate;
    Image<float> velocity;  ///< deg/s
};

inline SyntheticFrame make_synthetic_frame(int width, int height, std::uint32_t seed = 0) {
    struct Ball {
        double x, y, radius;  ///< in units of the height
        Rgb color;
        double speed;  ///< deg/s
    };
    const std::array<Ball, 5> balls = {{{0.35, 0.55, 0.11, {0.8f, 0.15f, 0.1f}, 24.0},
                                        {0.95, 0.40, 0.07, {0.9f, 0.8f, 0.1f}, 2.5},
                                        {1.10, 0.75, 0.09, {0.1f, 0.2f, 0.7f}, 8.0},
                                        {0.70, 0.82, 0.05, {0.9f, 0.9f, 0.9f}, 0.0},
                                        {0.15, 0.22, 0.04, {0.1f, 0.6f, 0.2f}, 60.0}}};
    SyntheticFrame frame{Image<Rgb>(width, height), Image<float>(width, height)};
    for (const auto [x, y] : all_pixels(width, height)) {
        const double u = (x + 0.5) / height, v = (y + 0.5) / height;
        RandomStream random({seed, 0, static_cast<std::uint32_t>(frame.estimate.index(x, y)), 0});
        Rgb color;
        double speed = 2.9;
        if (v > 0.6) {  // a floor of tiles in perspective
            const double depth = 1.0 / (v - 0.5);
            const bool odd =
                (static_cast<int>(std::floor((u - 0.67) * depth * 4 + 100)) + static_cast<int>(std::floor(depth * 6))) %
                    2 !=
                0;
            color = odd ? Rgb(0.45f, 0.32f, 0.2f) : Rgb(0.25f, 0.18f, 0.12f);
            speed += 2.0 * (v - 0.6);
        } else {  // a wall with a lamp's glow and some grain
            const double glow = std::exp(-6.0 * ((u - 0.7) * (u - 0.7) + (v - 0.1) * (v - 0.1)));
            const double grain = 0.04 * std::sin(61.0 * u + 3.0 * std::sin(23.0 * v));
            color = Rgb(static_cast<float>(0.2 + 0.5 * glow + grain)) * Rgb(1.0f, 0.95f, 0.85f);
            if (std::abs(u - 1.0) < 0.12 && std::abs(v - 0.3) < 0.08)
                color = Rgb(0.2f, 0.35f, 0.5f) * (0.5f + random.next());
        }
        for (const Ball& ball : balls) {
            const double dx = (u - ball.x) / ball.radius, dy = (v - ball.y) / ball.radius;
            const double d2 = dx * dx + dy * dy;
            if (d2 > 1.0) continue;
            const double shade = 0.15 + 0.85 * std::max(0.0, std::sqrt(1.0 - d2) * 0.8 - dx * 0.3 - dy * 0.5);
            const double shine = std::exp(-40.0 * ((dx + 0.3) * (dx + 0.3) + (dy + 0.45) * (dy + 0.45)));
            color = ball.color * static_cast<float>(shade) + Rgb(static_cast<float>(1.5 * shine));
            speed = ball.speed;
        }
        frame.estimate(x, y) = color * (0.99f + 0.02f * random.next());
        frame.velocity(x, y) = static_cast<float>(speed);
    }
    return frame;
}

/// R_i of (5.3), finest first; they sum to 1 everywhere.
inline std::vector<Image<float>> compute_band_response(const Image<Rgb>& picture) {
    const Image<float> still(picture.width, picture.height);
    return compute_perception(picture, still, {}, {}, {.guide = Guide::spatial}, {.bands = true}).responses;
}

inline std::vector<Image<float>> compute_band_response(const Image<float>& grey) {
    Image<Rgb> picture(grey.width, grey.height);
    for (std::size_t i = 0; i < grey.size(); ++i) picture.pixels[i] = Rgb(grey.pixels[i]);
    return compute_band_response(picture);
}

inline std::vector<float> all_maps() {
    const SyntheticFrame frame = make_synthetic_frame(97, 71);
    std::vector<float> values;
    for (const VisionModel* const vision : {&thesis_vision(), &laird_vision(), &castle_vision()}) {
        for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
            const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {},
                                                           {.vision = vision, .grid = grid}, {true, true});
            for (const Image<float>* map :
                 {&maps.aleph, &maps.saliency, &maps.retinal_velocity, &maps.adaptation, &maps.conspicuity_intensity,
                  &maps.conspicuity_color, &maps.conspicuity_orientation, &maps.conspicuity_motion})
                values.insert(values.end(), map->pixels.begin(), map->pixels.end());
        }
    }
    return values;
}

/// tvi_row of one value.
inline double tvi(double luminance) {
    const auto value = static_cast<float>(luminance);
    float out = 0.0f;
    tvi_row(&value, 1, &out);
    return out;
}

class OnesVision final : public PlainVision {
  public:
    std::string name() const override { return "ones"; }
    std::string summary() const override { return "the same elevation everywhere"; }
    double elevation(const Stimulus& /*stimulus*/, const Presentation& /*shown*/) const override { return 1.0; }
    double threshold(double luminance) const override { return tvi(luminance); }
};

}  // namespace aleph
