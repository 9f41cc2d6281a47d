#pragma once
// Indirect light of the quick estimate at lighting keyframes (lighting_keyframes.h), carried to the frames between
// them: these gather only what no keyframe's camera saw.

#include <deque>
#include <memory>

#include "render/estimate/estimate.h"
#include "render/time/keyframe_light.h"

namespace aleph {

/// The gathers of a lighting keyframe's own estimate. They depend on scene, settings and keyframe alone.
struct EstimateKeyframe : KeyPose {
    EstimateKeyframe(std::int64_t keyframe, EstimateNodes gathered) : frame(keyframe), nodes(std::move(gathered)) {}

    std::int64_t frame = 0;
    EstimateNodes nodes;
};

/// Irradiance between two lighting keyframes, linear in time. What only one of them knows is taken from there.
class BlendedEstimate : public CarriedEstimate {
  public:
    /// @param weight  of `after`
    BlendedEstimate(std::shared_ptr<const EstimateKeyframe> before, std::shared_ptr<const EstimateKeyframe> after,
                    double weight);

    std::optional<Rgb> find(const PixelSurface& surface) const override;

  private:
    std::shared_ptr<const EstimateKeyframe> before_, after_;
    float weight_;
};

/// The keyframes that were used last. They are the same in whatever order frames ask for them.
class EstimateKeyframes {
  public:
    /// Null if the keyframe is not kept.
    std::shared_ptr<const EstimateKeyframe> find(std::int64_t frame);
    void keep(std::shared_ptr<const EstimateKeyframe> keyframe);

  private:
    std::deque<std::shared_ptr<const EstimateKeyframe>> keyframes_;  ///< used last first
};

}  // namespace aleph
