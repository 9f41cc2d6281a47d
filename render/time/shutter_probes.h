#pragma once
// How much indirect light changes while the shutter is open, by few paths from some places of the picture. They find
// what changes light far away: a blind, a door to a bright room.

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// Luminance of the indirect irradiance at each place; negative: hidden.
using ProbedLight = std::vector<float>;

/// A few paths of up to three bounces from each place. They have the same random numbers at all times, so that light
/// that does not change makes no difference.
/// @param lighting  at any time; the places may be of another one
/// @param counts    increased, rays as RayCounts::shadow
ProbedLight probe_light(const LightingContext& lighting, const std::vector<PixelSurface>& places, RayCounts& counts);

/// Share of the light that differs between two times, in parts of the picture.
struct LightChanges {
    static constexpr int across = 4;

    glm::ivec2 picture{0};  ///< pixels; 0: nothing changes
    std::array<float, across * across> shares{};

    std::size_t part(int x, int y) const { return y * across / picture.y * across + x * across / picture.x; }
    float at(int x, int y) const { return picture.x == 0 ? 0.0f : shares[part(x, y)]; }
    float largest() const { return *std::ranges::max_element(shares); }
    /// Keeps the larger ones. @param other  in the same picture, or none
    void add(const LightChanges& other);
};

/// Shares of the larger one of both, less two standard errors of the paths; none if one is empty.
LightChanges find_light_changes(const std::vector<PixelSurface>& places, glm::ivec2 picture, const ProbedLight& known,
                                const ProbedLight& sample);

struct WeighedLight {
    const ProbedLight* light;
    float weight;
};

/// The sum of several times, negative where one is; none if one is empty.
ProbedLight add_light(const std::vector<WeighedLight>& lights);

}  // namespace aleph
