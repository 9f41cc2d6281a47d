#pragma once
// Keeps the indirect light of the lighting keyframes that frames need, so that a sequence computes each keyframe once.

#include <functional>
#include <map>

#include "render/time/cache_file.h"
#include "render/time/keyframe_light.h"

namespace aleph {

/// How the scene is seen at a lighting keyframe.
struct KeyframeSource {
    /// The scene at a frame.
    std::function<std::shared_ptr<const KeyPose>(std::int64_t frame)> pose;
    /// The view of a frame's camera, with its accuracy.
    std::function<std::shared_ptr<const KeyView>(std::int64_t frame)> look;
    /// The first sample of every pixel of a view.
    CastView cast;
    /// The scene at a frame, valid until the next call of `pose` or `look`.
    std::function<LightingContext(std::int64_t frame, RayCounts& counts)> light;
};

/// Results that a frame keeps of the keyframes that are computed for it.
struct KeyframeWork {
    std::vector<KeyframeStatistics>& filled;  ///< they are added
    const FrameProgress& progress;            ///< may be empty
    FrameCheckpoint* checkpoint = nullptr;    ///< may be null
};

/// The light of every keyframe is a function of scene, settings and keyframe alone, so frames do not depend on the
/// order in which they are rendered.
class ShotLight {
  public:
    /// @param still     nothing but the camera changes
    /// @param unmoving  nothing changes at all: one keyframe serves every frame
    ShotLight(LightingKeyframes keyframes, const RenderSettings& settings, bool still, bool unmoving,
              KeyframeSource source)
        : keyframes_(std::move(keyframes)),
          settings_(settings),
          still_(still),
          unmoving_(unmoving),
          source_(std::move(source)) {}

    /// The lighting keyframes whose light a frame reads.
    KeyframePair keyframes_around(std::int64_t frame) const {
        return find_keyframes(keyframes_, unmoving_ ? keyframes_.range.first : frame);
    }

    /// The keyframe with whose light a lighting keyframe begins: itself, unless only the camera moves.
    std::int64_t find_base(std::int64_t keyframe) const;

    /// The scene at the lighting keyframes whose light `at` gave for this frame; nothing if nothing but the camera
    /// changes, or if the frame is a lighting keyframe.
    std::vector<const ShadingScene*> scenes_around(std::int64_t frame) const;

    /// The light that a frame reads. Computes the lighting keyframes around the frame, unless they are kept from
    /// before.
    std::unique_ptr<CarriedLight> at(std::int64_t frame, const KeyframeWork& work);

    /// Keeps the records of all keyframes there; those that it has need not be computed.
    void use(LightStore store) { store_.emplace(std::move(store)); }
    /// Null before `use`.
    LightStore* store() { return store_ ? &*store_ : nullptr; }

  private:
    std::vector<std::int64_t> list_views(std::int64_t keyframe) const;
    std::unique_ptr<BlendedLight> blend(const KeyframePair& pair) const;
    /// Finds the keyframe's light, or computes it at the surfaces of these views where `carried` does not know it.
    void prepare(std::int64_t keyframe, const std::vector<std::int64_t>& views, const CarriedLight* carried,
                 const KeyframeWork& work);
    KeyframeRecords compute(std::int64_t keyframe, const std::vector<std::int64_t>& frames, const CarriedLight* carried,
                            const KeyframeLight* base, const KeyframeWork& work);

    LightingKeyframes keyframes_;
    const RenderSettings& settings_;
    bool still_, unmoving_;
    KeyframeSource source_;
    std::optional<LightStore> store_;
    std::map<std::int64_t, std::shared_ptr<const KeyView>> views_;
    std::map<std::int64_t, std::shared_ptr<const KeyframeLight>> lights_;
};

}  // namespace aleph
