#pragma once
// An equirectangular picture that surrounds the scene, sampled in proportion to its luminance.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/base/color.h"
#include "engine/scene/material.h"

namespace aleph {

struct LuminanceRange {
    float least = 0.0f, most = 0.0f;
};

/// In the picture's own frame: its middle column lies along -z, u grows towards +x, its top row is +y.
struct EnvironmentMap {
    Image<Rgb> texels;  ///< radiance, linear; finite and not negative
    /// Per row and column: cumulative probabilities. A texel's probability is in proportion to its solid angle times
    /// the mean luminance of the bilinear picture over it, so that sampling covers whatever a look-up can return.
    std::vector<float> rows;             ///< height values; the last is 1
    std::vector<float> columns;          ///< width values per row; the last of a row is 1
    std::vector<float> probabilities;    ///< per texel
    bool black = true;                   ///< every texel is 0
    double mean_luminance = 0.0;         ///< over the sphere
    std::vector<LuminanceRange> ranges;  ///< of look-ups in each part of EnvironmentCells(map, ranges_step)

    bool empty() const { return texels.empty(); }
};

inline constexpr int ranges_step = 8;

/// The index of the part of [0,1) that u falls into, given where each part ends; u is stretched to [0,1) within it.
int choose_part(std::span<const float> ends, float& u);

/// 8-bit pictures are decoded from sRGB.
EnvironmentMap make_environment_map(const SceneImage& image);

/// Four texels that a look-up interpolates.
struct BetweenTexels {
    int column = 0, row = 0;          ///< of the first; row -1 above the centres of the top row
    float right = 0.0f, down = 0.0f;  ///< in [0,1], from its centre
};
BetweenTexels place_between_texels(const EnvironmentMap& map, const glm::vec3& direction);

/// Bilinear; wraps around the seam.
/// @param direction  unit
Rgb look_up(const EnvironmentMap& map, const glm::vec3& direction);

struct EnvironmentSample {
    glm::vec3 direction{0.0f};  ///< unit
    float pdf = 0.0f;           ///< per steradian; 0: the map is black
};

EnvironmentSample sample_environment(const EnvironmentMap& map, const glm::vec2& u);
/// Density of sample_environment.
float pdf_environment(const EnvironmentMap& map, const glm::vec3& direction);

}  // namespace aleph
