#pragma once
// The interface of a model of vision, as the Aleph map and its thresholds use it. vision_list.h names the models;
// perception/README.md says how to add one.

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/frame_rate.h"
#include "engine/base/viewing.h"
#include "perception/vision/band_frequencies.h"
#include "perception/vision/retinal_velocity.h"

namespace aleph {

inline constexpr double highest_aleph = 250.76;  ///< of every model: the supremum of Kelly's CSF_max is 250.751
/// deg/s; above 1.8e5 no contrast is visible, and the factor f of every band is 1.
inline constexpr float max_model_velocity = 1e6f;

/// How pictures are shown.
struct Presentation {
    ViewingConditions viewing;
    FrameRate frame_rate;
};

/// Contrast at one place of a picture (PlainVision), as it reaches the eye.
struct Stimulus {
    double frequency = 0.0;           ///< cycles per degree
    double retinal = drift_velocity;  ///< v_R, deg/s
    double tracked = 0.0;             ///< what the eye follows, deg/s
    double luminance = 100.0;         ///< that the eye is adapted to, cd/m2
};

/// The same of the pixels of a row, apart from frequency.
struct StimulusRow {
    const float* retinal = nullptr;    ///< v_R, deg/s, each finite and at least the drift
    const float* tracked = nullptr;    ///< deg/s, each in [0, pursuit_limit]
    const float* luminance = nullptr;  ///< cd/m2; null unless the model uses_luminance()
};

/// Elevations of the bands in one row of pixels, in float. Each thread needs its own.
class ElevationRow {
  public:
    virtual ~ElevationRow() = default;

    /// Takes a row. The following calls answer for it; they may read from it.
    virtual void load(const StimulusRow& row) = 0;

    /// out[x] = f of a band.
    virtual void elevations(int band, float* out) const = 0;
};

/// Makes the elevations of a row of some width.
using ElevationRowMaker = std::function<std::unique_ptr<ElevationRow>(int width)>;

/// A model of vision: thresholds of contrast and of luminance. All functions depend on their arguments only.
class VisionModel {
  public:
    virtual ~VisionModel() = default;

    /// The value of the setting `vision`.
    virtual std::string name() const = 0;

    /// A few words for help, such as "castleCSF 2024".
    virtual std::string summary() const = 0;

    /// Returns true if elevations depend on luminance.
    virtual bool uses_luminance() const { return false; }

    /// Returns true if elevations depend on ViewingConditions::persistence.
    virtual bool uses_persistence() const { return false; }

    /// Threshold elevation f of rows of pixels: the factor by which the least visible contrast is raised, [1,
    /// highest_aleph].
    /// @param rho  frequencies of the bands, cycles per degree
    virtual ElevationRowMaker make_rows(const std::array<double, band_count>& rho, const Presentation& shown) const = 0;

    /// The least visible luminance differences where f is 1, cd/m2, of an eye that is adapted to each of `count`
    /// luminances, cd/m2. Every input has a finite positive result.
    virtual void thresholds(const float* luminance, std::size_t count, float* out) const = 0;
};

/// A model that says one value at a time, in double: easier to write, and slower.
class PlainVision : public VisionModel {
  public:
    virtual double elevation(const Stimulus& stimulus, const Presentation& shown) const = 0;
    virtual double threshold(double luminance) const = 0;
    ElevationRowMaker make_rows(const std::array<double, band_count>& rho, const Presentation& shown) const override;
    void thresholds(const float* luminance, std::size_t count, float* out) const override;
};

}  // namespace aleph
