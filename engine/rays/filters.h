#pragma once
// Embree's filters: callbacks that refuse a hit, and what they find in the context of a query. Internal to engine/rays.

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <span>

#include "engine/rays/ray_scene.h"

namespace aleph {

inline constexpr int max_packet_width = 16;

/// On every geometry: of hits at one distance it keeps the lowest (instance, primitive), so that the result does not
/// depend on the order in which a tree finds them. Within an instance, triangles that face the ray come before those
/// that show their back: from afar both sides of a thin wall are at one distance, and the near one must be met.
void keep_lowest_of_nearest(const RTCFilterFunctionNArguments* arguments);

/// The filters of meshes with holes (their user data is the AlphaCutout), of first hits and of occlusion.
void keep_lowest_of_nearest_but_holes(const RTCFilterFunctionNArguments* arguments);
void pass_holes(const RTCFilterFunctionNArguments* arguments);

/// Embree passes its context to the filters; this is what they find in it.
struct RayContext {
    RTCIntersectContext embree;  ///< first
    const RayScene::State* state;
    bool random;                                       ///< for blended surfaces: see Blend
    std::array<std::uint64_t, max_packet_width> keys;  ///< if random: of each ray, made from all its bits

    RayContext(const RayScene::State& of, Blend blend, bool coherent);
    /// The rays to be traced, lane by lane. The filters themselves see rays in the object's space, which no two kinds
    /// of packets round alike, and with another end.
    void set_rays(std::span<const Ray> rays) {
        if (random) make_keys(rays);
    }

  private:
    void make_keys(std::span<const Ray> rays);
};

/// What the filters of first hits know about the rays being traced.
struct FilterContext {
    RayContext common;  ///< first
    /// The hit that each ray has accepted so far: the hit part of the packet that Embree was given.
    RTCHitN* accepted;
    std::array<float, max_packet_width> far;       ///< where each ray ends by itself
    std::array<float, max_packet_width> nearest;   ///< distance of the nearest hit offered
    std::array<float, max_packet_width> distance;  ///< of the one accepted, which ties with it

    FilterContext(const RayScene::State& state, Blend blend, bool coherent, void* hits);
};

}  // namespace aleph
