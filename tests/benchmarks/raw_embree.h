#pragma once
// Embree alone, for comparison: the same rays through the same triangles, one by one or in packets of 16.

#include <embree3/rtcore.h>

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
    /// All triangles in one tree.
    /// @param origin  m, world, of rays and triangles
    RawEmbree(const Scene& scene, const ScenePose& frame, const glm::dvec3& origin);
    ~RawEmbree();
    RawEmbree(const RawEmbree&) = delete;
    RawEmbree& operator=(const RawEmbree&) = delete;

    enum class Packets {
        none,        ///< rays one by one
        incoherent,  ///< of 16 rays of the same kind, in their order
        coherent,    ///< the same, with Embree's coherent flag for those that look for the nearest hit
    };
    /// Traces given rays on all threads.
    /// @return number of hits
    std::size_t trace(const std::vector<RawRay>& rays, Packets packets) const;

  private:
    RTCDevice device_ = nullptr;
    RTCScene top_ = nullptr;
};

}  // namespace aleph
