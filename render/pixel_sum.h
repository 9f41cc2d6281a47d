#pragma once
// The samples of one pixel, added up.

#include <glm/vec3.hpp>

#include "engine/base/color.h"

namespace aleph {

/// The valid samples of a pixel so far. In double: a float sum of 65,536 samples can be off by 0.2 %.
struct PixelSum {
    glm::dvec3 radiance{0.0};
    int samples = 0, hits = 0;
    double mean_luminance = 0.0, squares = 0.0;  ///< squared differences from the mean (Welford 1962)

    void add(const Rgb& sample, bool hit) {
        radiance += glm::dvec3(sample);
        ++samples;
        if (hit) ++hits;
        const double y = luminance(sample), difference = y - mean_luminance;
        mean_luminance += difference / samples;
        squares += difference * (y - mean_luminance);
    }
    /// Of the mean luminance, from 2 samples or more.
    double variance() const { return squares / (static_cast<double>(samples - 1) * samples); }
};

}  // namespace aleph
