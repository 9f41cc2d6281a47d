// The one checked door to Embree: Debian's build ends the process on a ray with a NaN (HARD_CASES RC-01), so every ray
// is looked at first, and a bad one is a miss that is counted.

#include <cmath>

#include "engine/base/errors.h"
#include "engine/ray_scene.h"
#include "engine/ray_scene_state.h"

namespace aleph {

namespace {

/// The direction with components that are next to nothing made 0: a denormal one of a wrong sign makes Embree's
/// coherent packets lose hits of the other rays.
glm::vec3 embree_direction(const Ray& ray) {
    const auto clean = [](float v) { return std::abs(v) < 1e-30f ? 0.0f : v; };
    return {clean(ray.direction.x), clean(ray.direction.y), clean(ray.direction.z)};
}

bool is_valid(const Ray& ray) {
    const auto fits = [](const glm::vec3& v) {
        // NaN fails every comparison.
        return std::abs(v.x) < largest_ray_component && std::abs(v.y) < largest_ray_component &&
               std::abs(v.z) < largest_ray_component;
    };
    return fits(ray.origin) && fits(ray.direction) && ray.near >= 0.0f && ray.near < largest_ray_component &&
           ray.far >= ray.near && embree_direction(ray) != glm::vec3(0.0f);
}

RTCIntersectContext make_context(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

Hit make_hit(const MeshStructures& meshes, unsigned object, unsigned geometry, unsigned primitive, float u, float v,
             float distance) {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
    return {meshes.objects[object].first_instance + static_cast<int>(geometry), static_cast<int>(primitive), u, v,
            distance};
}

/// Embree's packet types by width.
template <int Width>
struct Packet;
template <>
struct Packet<8> {
    using Rays = RTCRay8;
    using RayHits = RTCRayHit8;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RayHits* rays) {
        rtcIntersect8(valid, scene, context, rays);
    }
    static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Rays* rays) {
        rtcOccluded8(valid, scene, context, rays);
    }
};
template <>
struct Packet<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, RayHits* rays) {
        rtcIntersect16(valid, scene, context, rays);
    }
    static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Rays* rays) {
        rtcOccluded16(valid, scene, context, rays);
    }
};

struct PacketCounts {
    std::uint64_t traced = 0, invalid = 0;
};

/// Fills lane i; invalid rays and lanes beyond the end are switched off.
template <class Rays>
void fill_lane(Rays& packet, int* valid, int lane, const Ray* ray, PacketCounts& counts) {
    const bool good = ray != nullptr && is_valid(*ray);
    if (ray != nullptr) ++(good ? counts.traced : counts.invalid);
    valid[lane] = good ? -1 : 0;
    const Ray& r = good ? *ray : Ray{};
    packet.org_x[lane] = r.origin.x;
    packet.org_y[lane] = r.origin.y;
    packet.org_z[lane] = r.origin.z;
    const glm::vec3 direction = embree_direction(r);
    packet.dir_x[lane] = direction.x;
    packet.dir_y[lane] = direction.y;
    packet.dir_z[lane] = direction.z;
    packet.tnear[lane] = r.near;
    packet.tfar[lane] = r.far;
    packet.time[lane] = 0.0f;
    packet.mask[lane] = ~0u;
    packet.id[lane] = static_cast<unsigned>(lane);
    packet.flags[lane] = 0;
}

template <int Width>
PacketCounts intersect_packets(const RayScene::State& state, std::span<const Ray> rays, std::span<Hit> hits,
                               bool coherent) {
    PacketCounts counts;
    RTCIntersectContext context = make_context(coherent);
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::RayHits packet;
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
        for (int lane = 0; lane < Width; ++lane) {
            const std::size_t i = begin + static_cast<std::size_t>(lane);
            fill_lane(packet.ray, valid, lane, i < rays.size() ? &rays[i] : nullptr, counts);
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        Packet<Width>::intersect(valid, state.top, &context, &packet);
        for (int lane = 0; lane < Width && begin + static_cast<std::size_t>(lane) < rays.size(); ++lane) {
            hits[begin + static_cast<std::size_t>(lane)] =
                make_hit(*state.meshes, packet.hit.instID[0][lane], packet.hit.geomID[lane], packet.hit.primID[lane],
                         packet.hit.u[lane], packet.hit.v[lane], packet.ray.tfar[lane]);
        }
    }
    return counts;
}

template <int Width>
PacketCounts occluded_packets(const RayScene::State& state, std::span<const Ray> rays,
                              std::span<std::uint8_t> blocked) {
    PacketCounts counts;
    // Never "coherent": with that flag this Embree's occlusion packets can loop for ever over instances.
    RTCIntersectContext context = make_context(false);
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::Rays packet;
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
        for (int lane = 0; lane < Width; ++lane) {
            const std::size_t i = begin + static_cast<std::size_t>(lane);
            fill_lane(packet, valid, lane, i < rays.size() ? &rays[i] : nullptr, counts);
        }
        Packet<Width>::occluded(valid, state.top, &context, &packet);
        for (int lane = 0; lane < Width && begin + static_cast<std::size_t>(lane) < rays.size(); ++lane) {
            blocked[begin + static_cast<std::size_t>(lane)] = valid[lane] != 0 && packet.tfar[lane] < 0.0f;
        }
    }
    return counts;
}

}  // namespace

Tracer::Tracer(const RayScene& scene) : state_(*scene.state_) {}

Tracer::~Tracer() {
    if (traced_ > 0) state_.rays_traced.fetch_add(traced_, std::memory_order_relaxed);
    if (invalid_ > 0) state_.invalid_rays.fetch_add(invalid_, std::memory_order_relaxed);
}

Hit Tracer::intersect(const Ray& ray) {
    if (!is_valid(ray)) {
        ++invalid_;
        return {};
    }
    ++traced_;
    RTCIntersectContext context = make_context(false);
    RTCRayHit query{};
    const glm::vec3 direction = embree_direction(ray);
    query.ray = {ray.origin.x, ray.origin.y, ray.origin.z, ray.near, direction.x, direction.y,
                 direction.z,  0.0f,         ray.far,      ~0u,      0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_.top, &context, &query);
    return make_hit(*state_.meshes, query.hit.instID[0], query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v,
                    query.ray.tfar);
}

bool Tracer::occluded(const Ray& ray) {
    if (!is_valid(ray)) {
        ++invalid_;
        return false;
    }
    ++traced_;
    RTCIntersectContext context = make_context(false);
    const glm::vec3 direction = embree_direction(ray);
    RTCRay query = {ray.origin.x, ray.origin.y, ray.origin.z, ray.near, direction.x, direction.y,
                    direction.z,  0.0f,         ray.far,      ~0u,      0,           0};
    rtcOccluded1(state_.top, &context, &query);
    return query.tfar < 0.0f;
}

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent) {
    ALEPH_CHECK(rays.size() == hits.size(), std::to_string(rays.size()) + " rays, " + std::to_string(hits.size()));
    const PacketCounts counts = state_.meshes->packet_width == 16 ? intersect_packets<16>(state_, rays, hits, coherent)
                                                                  : intersect_packets<8>(state_, rays, hits, coherent);
    traced_ += counts.traced;
    invalid_ += counts.invalid;
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    ALEPH_CHECK(rays.size() == blocked.size(),
                std::to_string(rays.size()) + " rays, " + std::to_string(blocked.size()));
    const PacketCounts counts = state_.meshes->packet_width == 16 ? occluded_packets<16>(state_, rays, blocked)
                                                                  : occluded_packets<8>(state_, rays, blocked);
    traced_ += counts.traced;
    invalid_ += counts.invalid;
}

}  // namespace aleph
