#pragma once
// Times of an open shutter at which indirect light is computed, for samples at times between them. Light is
// interpolated within spans in which it does not jump.

#include <memory>
#include <vector>

#include "render/time/keyframe_light.h"
#include "render/time/shutter.h"
#include "render/time/shutter_light.h"

namespace aleph {

struct ShutterSpan {
    double open = 0.0, close = 0.0;                      ///< frames
    std::shared_ptr<const KeyframeLight> before, after;  ///< null: nothing changes after the first
    LightChanges changes{};                              ///< from what is interpolated, in the middle
};

/// Light at one time of the shutter.
class LightInSpan {
  public:
    /// Keeps references. @param at  frames, within the span
    LightInSpan(const ShutterSpan& span, double at, const ShadingScene& sample);
    LightInSpan(const LightInSpan&) = delete;

    const ShutterLight& light() const { return light_; }

  private:
    ShutterLight light_;  ///< reads `between_`
    BlendedLight between_;
};

/// Null between spans: nothing is known there.
const ShutterSpan* find_span(const std::vector<ShutterSpan>& spans, double at);

/// A pose of a shutter's span.
struct KeyTime {
    double at = 0.0;  ///< frames
    std::shared_ptr<const KeyPose> pose;
};

/// Poses of the scene while the shutter is open.
using PoseAt = std::function<std::shared_ptr<const KeyPose>(double at)>;

/// Where light is wanted, and how accurately.
struct ShutterPlaces {
    std::vector<PixelSurface> surfaces;
    const ShadingScene& shading;   ///< of the surfaces, at the shutter's centre
    const Image<float>& accuracy;  ///< alpha per pixel
    ProbedLight probed{};          ///< at the shutter's centre; empty while all poses are as that

    const ProbedLight& probed_at(const KeyPose& pose) const { return pose.probed.empty() ? probed : pose.probed; }
    glm::ivec2 picture() const { return {accuracy.width, accuracy.height}; }
};

/// First and last time of a span.
struct KeySpan {
    KeyTime first, last;
    LightChanges changes{};  ///< of ShutterSpan
};

struct ShutterTimes {
    /// None: light of the shutter's centre does, or most of it changes too fast for any number of spans.
    std::vector<KeySpan> spans;
    /// From the light of the centre to the mean of the shutter: what changes evenly with time cancels. Of no use where
    /// light jumps.
    LightChanges from_center;
};

/// Returns whether things and lights are the same in two poses. The cameras may differ.
bool is_same(const ShadingScene& a, const ShadingScene& b);

/// Chooses the spans for light at these places: as many as nearly all of it needs, while each doubling makes much more
/// of it known.
/// @param jumps  frames, at which light may jump, in order
/// @param most   spans; 0: changes from the centre alone
ShutterTimes choose_times(const ShutterInterval& shutter, const std::vector<double>& jumps, const ShutterPlaces& places,
                          const PoseAt& pose, int most);

/// Records that hold in another pose too, to this accuracy.
KeyframeRecords find_lasting(const KeyframeLight& light, const ShutterPlaces& places, const KeyPose& to,
                             float accuracy);

}  // namespace aleph
