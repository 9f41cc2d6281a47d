#include "render/compare/surface_track.h"

#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Targets are rounded to a thousandth of a pixel, so that rounding brings in no neighbour.
float snap(float value) {
    return std::round(value * 1000.0f) / 1000.0f;
}

/// The pixel whose centre is nearest, if it lies inside the picture.
std::optional<std::size_t> nearest(const Image<float>& image, glm::vec2 p) {
    if (!(p.x >= -0.5f && p.y >= -0.5f && p.x < static_cast<float>(image.width) - 0.5f &&
          p.y < static_cast<float>(image.height) - 0.5f)) {
        return std::nullopt;
    }
    return image.index(static_cast<int>(p.x + 0.5f), static_cast<int>(p.y + 0.5f));
}

float object_at(const MotionMaps& maps, std::size_t i) {
    return maps.object.empty() ? 0.0f : maps.object.pixels[i];
}

/// Motion at a place of an object, x right and y down: between the pixels around it that are of this object.
std::optional<glm::vec2> motion_at(const MotionMaps& maps, glm::vec2 p, float object) {
    if (!nearest(maps.u, p)) return std::nullopt;
    const float left = std::floor(p.x), top = std::floor(p.y);
    glm::vec2 sum{0.0f};
    float weights = 0.0f;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const glm::vec2 at{left + static_cast<float>(dx), top + static_cast<float>(dy)};
            const float weight = (1.0f - std::abs(p.x - at.x)) * (1.0f - std::abs(p.y - at.y));
            const auto i = nearest(maps.u, at);
            if (weight <= 0.0f || !i || !moves_as_told(maps.valid.pixels[*i]) || object_at(maps, *i) != object)
                continue;
            sum += weight * glm::vec2{maps.u.pixels[*i], -maps.v.pixels[*i]};
            weights += weight;
        }
    }
    if (!(weights > 0.0f)) return std::nullopt;
    return sum / weights;
}

bool shows(const MotionMaps& maps, glm::vec2 p, float object) {
    const auto i = nearest(maps.u, p);
    return i && object_at(maps, *i) == object;
}

/// The place in the frame before from which the motion leads to `p`, by fixed-point iteration.
std::optional<glm::vec2> trace_back(const MotionMaps& before, glm::vec2 p, float object, glm::vec2 guess) {
    glm::vec2 q = p - guess;
    for (int i = 0; i < 4; ++i) {
        const auto motion = motion_at(before, q, object);
        if (!motion) return std::nullopt;
        q = p - *motion;
    }
    const auto motion = motion_at(before, q, object);
    if (!motion) return std::nullopt;
    const glm::vec2 miss = q + *motion - p;
    if (std::abs(miss.x) + std::abs(miss.y) > 0.5f) return std::nullopt;
    return q;
}

/// Moves every position of `tracks` one frame on. @param step  (position, object) to the next position
template <class Step>
TrackImage advance(const TrackImage& tracks, const MotionMaps& origin, const Step& step) {
    TrackImage out(tracks.width, tracks.height, glm::vec2{unknown});
    parallel_rows(tracks.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < tracks.width; ++x) {
                const std::size_t i = tracks.index(x, y);
                const glm::vec2 p = tracks.pixels[i];
                if (std::isnan(p.x)) continue;
                const std::optional<glm::vec2> next = step(p, object_at(origin, i));
                if (next) out.pixels[i] = {snap(next->x), snap(next->y)};
            }
        }
    });
    return out;
}

TrackImage own_positions(const MotionMaps& maps) {
    TrackImage tracks(maps.u.width, maps.u.height);
    for (int y = 0; y < tracks.height; ++y) {
        for (int x = 0; x < tracks.width; ++x) tracks(x, y) = {static_cast<float>(x), static_cast<float>(y)};
    }
    return tracks;
}

}  // namespace

MotionMaps read_motion(const ChannelImage& maps) {
    const Image<float>*u = maps.find("forward.u"), *v = maps.find("forward.v"), *valid = maps.find("motion.valid");
    const Image<float>* object = maps.find("objectId.X");
    if (u && v && valid) return {*u, *v, *valid, object ? *object : Image<float>{}};
    const int width = maps.channels.empty() ? 0 : maps.channels.front().values.width;
    const int height = maps.channels.empty() ? 0 : maps.channels.front().values.height;
    return {Image<float>(width, height), Image<float>(width, height), Image<float>(width, height, 1.0f), {}};
}

SurfaceTracks track_surfaces(std::span<const MotionMaps* const> motion, std::size_t own) {
    SurfaceTracks tracks;
    const TrackImage start = own_positions(*motion[own]);
    for (std::size_t k = own; k + 1 < motion.size(); ++k) {
        const TrackImage& at = k == own ? start : tracks.after.back();
        tracks.after.push_back(advance(at, *motion[own], [&](glm::vec2 p, float object) -> std::optional<glm::vec2> {
            const auto step = motion_at(*motion[k], p, object);
            if (!step || !shows(*motion[k + 1], p + *step, object)) return std::nullopt;
            return p + *step;
        }));
    }
    for (std::size_t k = own; k > 0; --k) {
        const TrackImage& at = k == own ? start : tracks.before.back();
        tracks.before.push_back(advance(at, *motion[own], [&](glm::vec2 p, float object) {
            const glm::vec2 guess = motion_at(*motion[k], p, object).value_or(glm::vec2{0.0f});
            return trace_back(*motion[k - 1], p, object, guess);
        }));
    }
    return tracks;
}

}  // namespace aleph
