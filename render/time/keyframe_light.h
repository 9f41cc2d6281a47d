#pragma once
// Indirect light of lighting keyframes (lighting_keyframes.h): computed at each of them, and read by the frames in
// between, where a surface point lies at the keyframe.

#include <deque>
#include <functional>
#include <memory>

#include "engine/pose/posed_view.h"
#include "render/cache/cache_fill.h"
#include "render/estimate/estimate.h"
#include "render/time/lighting_keyframes.h"
#include "render/time/shutter_probes.h"

namespace aleph {

/// The scene at a lighting keyframe. `shading` points into it: it must not move.
struct KeyPose {
    PosedView posed;
    ShadingScene shading;
    ProbedLight probed{};  ///< while a shutter is open; empty: nothing differs from its centre
};

/// View of a lighting keyframe's camera.
struct KeyView : KeyPose {
    std::int64_t frame = 0;
    Image<float> accuracy;   ///< alpha per pixel
    Image<float> tolerance;  ///< of noise that lasts (IndirectContext); empty: no error is asked for
    RayCounts rays;          ///< of its first hits and its quick estimate
};

/// The records of a lighting keyframe.
struct KeyframeRecords {
    std::vector<IrradianceRecord> seen;     ///< at what cameras see
    std::vector<IrradianceRecord> further;  ///< FurtherBounces, where other frames may read it
};

/// The light of a lighting keyframe.
struct KeyframeLight {
    std::shared_ptr<const KeyPose> at;
    IrradianceCache cache;
    std::vector<IrradianceRecord> further;  ///< of KeyframeRecords
};

/// @param records  of this keyframe, from compute_records
KeyframeLight make_keyframe_light(std::shared_ptr<const KeyPose> at, const KeyframeRecords& records);

/// The first sample of every pixel of a view; adds its rays.
using CastView = std::function<SampleHits(const KeyView& view, RayCounts& counts)>;

/// Inputs of a keyframe's light.
struct KeyframeInput {
    std::int64_t frame = 0;
    const LightingContext& lighting;  ///< the scene at the keyframe
    /// Their surfaces, taken to where they lie at the keyframe, get records.
    const std::vector<std::shared_ptr<const KeyView>>& views;
    const RenderSettings& settings;
    const CastView& cast;
    const CarriedLight* carried = nullptr;  ///< where it knows the light no records are needed; may be null
    const KeyframeLight* base = nullptr;    ///< its records hold at this keyframe too; may be null
    bool still = false;                     ///< nothing but the camera changes
    FrameProgress progress{};               ///< may be empty
    FrameCheckpoint* checkpoint = nullptr;  ///< its fill has begun; may be null
};

/// The records of a base keyframe, if there is one, and those computed at surfaces that they do not cover.
KeyframeRecords compute_records(const KeyframeInput& input, FrameCounts& counts);

/// Changes between two times at which light is known.
enum class BetweenKeys : std::uint8_t {
    anything,
    still,   ///< nothing but the camera changes: light that only one of them has holds at the other
    smooth,  ///< a bound of how far light is from linear is kept by others (shutter_light.h)
    linear,  ///< the same, and nothing moves: lights brighten or dim
};

/// Light of the keyframes before and after a frame.
class BlendedLight : public CarriedLight {
  public:
    /// @param after   null at a keyframe itself
    /// @param weight  of `after`
    BlendedLight(std::shared_ptr<const KeyframeLight> before, std::shared_ptr<const KeyframeLight> after, double weight,
                 BetweenKeys between)
        : before_(std::move(before)),
          after_(std::move(after)),
          weight_(static_cast<float>(weight)),
          between_(between) {}

    /// Light of keyframes nearer to the frame, for what these keyframes do not know.
    void set_finer(std::unique_ptr<const BlendedLight> finer) { finer_ = std::move(finer); }

    std::optional<Rgb> find(const PixelSurface& surface, float accuracy, RayTask& task,
                            RecordUse* used = nullptr) const override;
    /// Those of the nearer keyframe, if nothing but the camera changes.
    std::vector<IrradianceRecord> find_further(const ShadingScene& frame) const override;

  private:
    std::optional<Rgb> read(const KeyframeLight& keyframe, const PixelSurface& surface, float accuracy, RayTask& task,
                            RecordUse& used) const;
    std::optional<Rgb> interpolate(const PixelSurface& surface, float accuracy, RayTask& task, RecordUse& used) const;

    std::shared_ptr<const KeyframeLight> before_, after_;
    float weight_;
    BetweenKeys between_;
    std::unique_ptr<const BlendedLight> finer_;
};

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
                    double weight)
        : before_(std::move(before)), after_(std::move(after)), weight_(static_cast<float>(weight)) {}

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
