#pragma once
// castleCSF (castle.h) as a model of vision, for rows of pixels in float. Elevations are castle_peak over
// castle_sensitivity times hold_transfer, [1, 153]. A sensitivity below 1 counts as 1, because no contrast exceeds 1.

#include <array>
#include <memory>
#include <vector>

#include "perception/vision/vision_model.h"

namespace aleph {

/// The bands: factors by band, and both channels' sensitivities over log luminance. The last of the eight lanes is not
/// used.
struct CastleTable {
    static constexpr int lanes = 8;
    using Lanes = std::array<float, lanes>;
    struct Node {
        Lanes sustained{}, transient{};
        float peak = 0.0f;  ///< castle_peak
    };

    /// @param rho  band frequencies, cycles per degree
    CastleTable(const std::array<double, band_count>& rho, const ViewingConditions& viewing,
                const FrameRate& frame_rate);

    Lanes sustained_decay{};   ///< the sustained response is 2^-(this v^1.3314)
    Lanes transient_factor{};  ///< omega^.1898 is this times v^.1898
    Lanes display_blur{};      ///< 4 rho / pi times the display's blur at 1 deg/s
    Lanes eye_blur{};          ///< 4 rho / pi times persistence
    Lanes rest_share{};        ///< that the eye's blur leaves at rest
    std::vector<Node> nodes;   ///< by LuminanceGrid
};

/// Elevations of a row, within 2e-3 of the formula, but for luminances within 1e-4 of .0113 cd/m2, where the fit begins
/// to have a transient channel.
class CastleRow final : public ElevationRow {
  public:
    CastleRow(std::shared_ptr<const CastleTable> table, int width);

    /// Luminances are clamped to the model's range; NaN counts as its lowest.
    void load(const StimulusRow& row) override;
    void elevations(int band, float* out) const override;

  private:
    std::shared_ptr<const CastleTable> table_;
    std::vector<float> log_luminance_;       ///< log2 of cd/m2, in the model's range
    std::vector<float> sustained_velocity_;  ///< v_R^1.3314
    std::vector<float> transient_velocity_;  ///< v_R^.1898
    std::vector<float> transient_peak_;      ///< castle_transient_peak^.1898
    std::array<std::vector<float>, band_count> elevations_;
};

}  // namespace aleph
