#pragma once
// Embree alone, for comparison: the same rays through the same triangles, prepared beforehand, in packets of 16.

#include <embree3/rtcore.h>

#include <optional>
#include <vector>

#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"

namespace aleph {

/// A ray in world space, relative to RawEmbree's origin.
struct RawRay {
    RTCRay ray;
    bool occlusion = false;  ///< whether anything is hit, not what
};

class RawEmbree {
  public:
    /// Instances as RayScene makes them; rays through the pixel centres in blocks of 4 x 4.
    /// @param flat    all triangles in one tree, in place of one for every mesh
    /// @param origin  m, world, of rays and triangles; nothing: the view's anchor
    RawEmbree(const Scene& scene, const ScenePose& frame, const CameraView& view, bool flat = false,
              const std::optional<glm::dvec3>& origin = {});
    ~RawEmbree();
    RawEmbree(const RawEmbree&) = delete;
    RawEmbree& operator=(const RawEmbree&) = delete;

    /// Traces every ray once. @return number of hits
    std::size_t trace();

    enum class Packets {
        none,        ///< rays one by one
        incoherent,  ///< of 16 rays of the same kind, in their order
        coherent,    ///< the same, with Embree's coherent flag for those that look for the nearest hit
    };
    /// Traces given rays on all threads.
    /// @return number of hits
    std::size_t trace(const std::vector<RawRay>& rays, Packets packets) const;

  private:
    void build_instances(const Scene& scene, const ScenePose& frame, const glm::dvec3& anchor);
    void build_flat(const Scene& scene, const ScenePose& frame, const glm::dvec3& anchor);

    RTCDevice device_ = nullptr;
    RTCScene top_ = nullptr;
    std::vector<RTCScene> meshes_;
    std::vector<RTCRayHit16> prepared_, packets_;
};

}  // namespace aleph
