#pragma once
// Keeps the indirect light of the key moments that frames need, so that a sequence computes each moment once.

#include <functional>
#include <map>

#include "render/time/cache_file.h"
#include "render/time/moment_light.h"

namespace aleph {

/// How the scene is seen at a key moment.
struct MomentSource {
    /// The scene at a frame.
    std::function<std::shared_ptr<const KeyPose>(std::int64_t frame)> pose;
    /// The view of a frame's camera, with its accuracy.
    std::function<std::shared_ptr<const KeyView>(std::int64_t frame)> look;
    /// The first sample of every pixel of a view.
    CastView cast;
    /// The scene at a frame, valid until the next call of `pose` or `look`.
    std::function<LightingContext(std::int64_t frame)> light;
};

/// The light of every moment is a function of scene, settings and moment alone, so frames do not depend on the order in
/// which they are rendered.
class ShotLight {
  public:
    /// @param still     nothing but the camera changes
    /// @param unmoving  nothing changes at all: one moment serves every frame
    ShotLight(KeyMoments moments, const RenderSettings& settings, bool still, bool unmoving, MomentSource source);

    /// The key moments whose light a frame reads.
    MomentPair moments_around(std::int64_t frame) const {
        return find_moments(moments_, unmoving_ ? moments_.range.first : frame);
    }

    /// The moment with whose light a key moment begins: itself, unless only the camera moves.
    std::int64_t find_base(std::int64_t moment) const;

    /// The scene at the key moments whose light `at` gave for this frame; nothing if nothing but the camera changes, or
    /// if the frame is a key moment.
    std::vector<const ShadingScene*> scenes_around(std::int64_t frame) const;

    /// The light that a frame reads. Computes the key moments around the frame, unless they are kept from before.
    /// @param filled  the moments that were computed are added
    std::unique_ptr<CarriedLight> at(std::int64_t frame, std::vector<MomentStatistics>& filled);

    /// Keeps the records of all moments, beginning with these, which need not be computed.
    void keep_records(MomentRecords records) { records_ = std::move(records); }
    /// All that are kept; nothing before keep_records.
    const std::optional<MomentRecords>& records() const { return records_; }

  private:
    std::vector<std::int64_t> list_views(std::int64_t moment) const;
    std::unique_ptr<BlendedLight> blend(const MomentPair& pair) const;
    /// Finds the moment's light, or computes it at the surfaces of these views where `carried` does not know it.
    void prepare(std::int64_t moment, const std::vector<std::int64_t>& views, const CarriedLight* carried,
                 std::vector<MomentStatistics>& filled);
    std::vector<IrradianceRecord> compute(std::int64_t moment, const std::vector<std::int64_t>& frames,
                                          const CarriedLight* carried, const MomentLight* base,
                                          std::vector<MomentStatistics>& filled);

    KeyMoments moments_;
    const RenderSettings& settings_;
    bool still_, unmoving_;
    MomentSource source_;
    std::optional<MomentRecords> records_;
    std::map<std::int64_t, std::shared_ptr<const KeyView>> views_;
    std::map<std::int64_t, std::shared_ptr<const MomentLight>> lights_;
};

}  // namespace aleph
