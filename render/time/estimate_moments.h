#pragma once
// Indirect light of the quick estimate at key moments (key_moments.h), carried to the frames between them: these gather
// only what no moment's camera saw.

#include <deque>
#include <memory>

#include "render/estimate/indirect_estimate.h"
#include "render/time/moment_light.h"

namespace aleph {

/// The gathers of a key moment's own estimate. They depend on scene, settings and moment alone.
struct EstimateMoment : KeyPose {
    EstimateMoment(std::int64_t moment, EstimateNodes gathered) : frame(moment), nodes(std::move(gathered)) {}

    std::int64_t frame = 0;
    EstimateNodes nodes;
};

/// Irradiance between two key moments, linear in time. What only one of them knows is taken from there.
class BlendedEstimate : public CarriedEstimate {
  public:
    /// @param weight  of `after`
    BlendedEstimate(std::shared_ptr<const EstimateMoment> before, std::shared_ptr<const EstimateMoment> after,
                    double weight);

    std::optional<Rgb> find(const PixelSurface& surface) const override;

  private:
    std::shared_ptr<const EstimateMoment> before_, after_;
    float weight_;
};

/// The moments that were used last. They are the same in whatever order frames ask for them.
class EstimateMoments {
  public:
    /// Null if the moment is not kept.
    std::shared_ptr<const EstimateMoment> find(std::int64_t frame);
    void keep(std::shared_ptr<const EstimateMoment> moment);

  private:
    std::deque<std::shared_ptr<const EstimateMoment>> moments_;  ///< used last first
};

}  // namespace aleph
