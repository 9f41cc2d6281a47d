#pragma once
// The maps of the three models of vision for the same frame, and what they differ in.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "perception/perception_settings.h"
#include "render/settings/settings.h"

namespace aleph {

inline const std::array all_visions = {&thesis_vision(), &laird_vision(), &castle_vision()};

/// Of one frame, from its quick estimate; nothing is rendered.
struct VisionMaps {
    Image<float> velocity;                                     ///< of the image, deg/s
    Image<float> retinal;                                      ///< v_R, deg/s: the same for every model
    std::array<Image<float>, all_visions.size()> aleph;        ///< by model
    std::array<Image<float>, all_visions.size()> threshold{};  ///< of an error that lasts, cd/m2
};

/// @throws InputError as Sequence
VisionMaps compute_vision_maps(const Scene& scene, const RenderSettings& settings, std::int64_t frame);

/// Pixels of a range of image velocity, deg/s.
struct SpeedClass {
    const char* name;
    double from, below;
};
inline constexpr std::array speed_classes = {SpeedClass{"all", 0.0, 1e30}, SpeedClass{"slow", 0.0, 1.0},
                                             SpeedClass{"medium", 1.0, 10.0}, SpeedClass{"fast", 10.0, 1e30}};

/// Values of the pixels of a class; `maps.velocity` that is not a number is in none.
std::vector<double> pick_pixels(const Image<float>& values, const Image<float>& velocity, const SpeedClass& speed);

/// a / b, value by value.
std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b);

/// Quantile q in [0,1] of values that are not empty: of the sorted, the one at floor(q (n - 1)).
double quantile(std::vector<double> values, double q);

/// Spearman's rank correlation; equal values share the mean of their ranks. 0 where all values of either are equal.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace aleph
