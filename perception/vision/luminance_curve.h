#pragma once
// Functions of luminance in float, from a table over log luminance.

#include <array>
#include <cmath>

#include "perception/vision/castle.h"
#include "perception/vision/fast_math.h"

namespace aleph {

/// Evenly spaced places on a scale of log luminance, from castle_min_luminance to castle_max_luminance.
struct LuminanceGrid {
    static constexpr int intervals = 372;  ///< 16 per octave
    static constexpr int nodes = intervals + 1;

    struct Place {
        int node = 0;           ///< the lower neighbour; the last interval is the highest
        float fraction = 0.0f;  ///< from there to the next node, [0,1]
    };

    /// cd/m2. @param parts  into which the scale is divided
    static double luminance(int node, int parts = intervals) {
        return castle_min_luminance *
               std::pow(castle_max_luminance / castle_min_luminance, static_cast<double>(node) / parts);
    }
    /// @param luminance  cd/m2; NaN counts as the lowest
    static float clamp(float luminance) {
        constexpr auto lowest = static_cast<float>(castle_min_luminance);
        constexpr auto highest = static_cast<float>(castle_max_luminance);
        const float positive = luminance > lowest ? luminance : lowest;
        return positive < highest ? positive : highest;
    }
    /// @param log_luminance  log2 of a clamped luminance
    static Place place(float log_luminance, int parts = intervals) {
        constexpr float log_lowest = -9.9657842846620870f, octaves = 23.253496664211536f;  // log2 of 1e-3 and of 1e7
        return place_at((log_luminance - log_lowest) * (static_cast<float>(parts) / octaves), parts);
    }
    /// @param at  in intervals; clamped
    static Place place_at(float at, int parts) {
        const float low = at > 0.0f ? at : 0.0f;
        const int node = low < static_cast<float>(parts - 1) ? static_cast<int>(low) : parts - 1;
        const float fraction = low - static_cast<float>(node);
        return {node, fraction < 1.0f ? fraction : 1.0f};
    }
};

/// cd/m2, in the range of thresholds: castle_min_luminance to 1e12; NaN is the lowest.
inline float clamp_threshold_luminance(float luminance) {
    constexpr auto lowest = static_cast<float>(castle_min_luminance), highest = 1e12f;
    const float positive = luminance > lowest ? luminance : lowest;
    return positive < highest ? positive : highest;
}

/// A smooth positive function of luminance: linear between the grid's places.
class LuminanceCurve {
  public:
    /// @param function  double to double; from cd/m2
    template <class Function>
    explicit LuminanceCurve(const Function& function) {
        for (int i = 0; i < LuminanceGrid::nodes; ++i) {
            values_[i] = static_cast<float>(function(LuminanceGrid::luminance(i)));
        }
    }

    float node(int i) const { return values_[i]; }

    /// @param luminance  cd/m2; clamped to the grid's range, NaN counts as its lowest
    float operator()(float luminance) const {
        const LuminanceGrid::Place place = LuminanceGrid::place(fast_log2(LuminanceGrid::clamp(luminance)));
        const float low = values_[place.node], high = values_[place.node + 1];
        return low + place.fraction * (high - low);
    }

  private:
    std::array<float, LuminanceGrid::nodes> values_;
};

/// castle_peak. The table is made once.
inline const LuminanceCurve& castle_peak_curve() {
    static const LuminanceCurve curve([](double luminance) { return castle_peak(luminance); });
    return curve;
}

}  // namespace aleph
