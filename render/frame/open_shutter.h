#pragma once
// The scene while the shutter is open: posed anew for every sample's time.

#include <optional>

#include "engine/pose/posed_view.h"
#include "render/shade/frame.h"

namespace aleph {

/// Keeps ray structures and shading of its own, and updates what moves.
class OpenShutter {
  public:
    /// Keeps references to all of them but `rays`, whose mesh structures it shares.
    /// @param camera  index into ScenePose::cameras
    OpenShutter(const Scene& scene, const PosePlan& plan, const TextureSet& textures, const RayScene& rays)
        : scene_(scene), plan_(plan), textures_(textures), rays_(rays.share_meshes()) {}

    /// The scene at a time, valid until the next call.
    /// @param skipped  effects that its shading leaves out
    SampleMoment move_to(double seconds, int camera, int width, int height, const EffectSet& skipped);

    std::uint64_t rays_traced() const { return rays_.rays_traced(); }

  private:
    const Scene& scene_;
    const PosePlan& plan_;
    const TextureSet& textures_;
    RayScene rays_;
    std::optional<PosedView> posed_;
    std::optional<ShadingScene> shading_;
    LightSet lights_;
};

}  // namespace aleph
