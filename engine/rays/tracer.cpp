// The only calls that trace rays. Embree ends the process on a ray with a NaN (Debian's build), so every ray is checked
// first: an invalid one is counted and is a miss.

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/rays/filters.h"
#include "engine/rays/ray_scene.h"
#include "engine/rays/state.h"

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
        return std::abs(v.x) < max_ray_component && std::abs(v.y) < max_ray_component &&
               std::abs(v.z) < max_ray_component;
    };
    return fits(ray.origin) && fits(ray.direction) && ray.near >= 0.0f && ray.near < max_ray_component &&
           ray.far >= ray.near && embree_direction(ray) != glm::vec3(0.0f);
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
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Packet<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
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
PacketCounts intersect_packets(const RayScene::State& state, Blend blend, std::span<const Ray> rays,
                               std::span<Hit> hits, bool coherent) {
    PacketCounts counts;
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::RayHits packet;
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
        for (int lane = 0; lane < Width; ++lane) {
            const std::size_t i = begin + static_cast<std::size_t>(lane);
            fill_lane(packet.ray, valid, lane, i < rays.size() ? &rays[i] : nullptr, counts);
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        const std::size_t count = std::min<std::size_t>(Width, rays.size() - begin);
        FilterContext context(state, blend, coherent, &packet.hit);
        context.common.set_rays(rays.subspan(begin, count));
        std::copy_n(packet.ray.tfar, Width, context.far.begin());
        for (const Layer* layer : state.layers())
            if (layer->enabled > 0) Packet<Width>::intersect(valid, layer->top.get(), &context.common.embree, &packet);
        for (std::size_t lane = 0; lane < count; ++lane) {
            hits[begin + lane] =
                make_hit(*state.meshes, packet.hit.instID[0][lane], packet.hit.geomID[lane], packet.hit.primID[lane],
                         packet.hit.u[lane], packet.hit.v[lane], context.distance[lane]);
        }
    }
    return counts;
}

template <int Width>
PacketCounts occluded_packets(const RayScene::State& state, Blend blend, std::span<const Ray> rays,
                              std::span<std::uint8_t> blocked) {
    PacketCounts counts;
    // Never "coherent": with that flag this Embree's occlusion packets can loop for ever over instances.
    RayContext context(state, blend, false);
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::Rays packet;
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
        for (int lane = 0; lane < Width; ++lane) {
            const std::size_t i = begin + static_cast<std::size_t>(lane);
            fill_lane(packet, valid, lane, i < rays.size() ? &rays[i] : nullptr, counts);
        }
        const std::size_t count = std::min<std::size_t>(Width, rays.size() - begin);
        context.set_rays(rays.subspan(begin, count));
        for (const Layer* layer : state.layers()) {
            if (layer->enabled == 0) continue;
            Packet<Width>::occluded(valid, layer->top.get(), &context.embree, &packet);
            bool open = false;  // a ray that is stopped has a negative end and is over
            for (std::size_t lane = 0; lane < count; ++lane) {
                if (packet.tfar[lane] < 0.0f) valid[lane] = 0;
                open = open || valid[lane] != 0;
            }
            if (!open) break;
        }
        for (std::size_t lane = 0; lane < count; ++lane) blocked[begin + lane] = packet.tfar[lane] < 0.0f;
    }
    return counts;
}

}  // namespace

Tracer::Tracer(const RayScene& scene, Blend blend) : state_(*scene.state_), blend_(blend) {}

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
    RTCRayHit query{};
    const glm::vec3 direction = embree_direction(ray);
    query.ray = {ray.origin.x, ray.origin.y, ray.origin.z, ray.near, direction.x, direction.y,
                 direction.z,  0.0f,         ray.far,      ~0u,      0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    FilterContext context(state_, blend_, false, &query.hit);
    context.common.set_rays({&ray, 1});
    context.far[0] = ray.far;
    for (const Layer* layer : state_.layers())
        if (layer->enabled > 0) rtcIntersect1(layer->top.get(), &context.common.embree, &query);
    return make_hit(*state_.meshes, query.hit.instID[0], query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v,
                    context.distance[0]);
}

bool Tracer::occluded(const Ray& ray) {
    if (!is_valid(ray)) {
        ++invalid_;
        return false;
    }
    ++traced_;
    RayContext context(state_, blend_, false);
    context.set_rays({&ray, 1});
    const glm::vec3 direction = embree_direction(ray);
    RTCRay query = {ray.origin.x, ray.origin.y, ray.origin.z, ray.near, direction.x, direction.y,
                    direction.z,  0.0f,         ray.far,      ~0u,      0,           0};
    for (const Layer* layer : state_.layers()) {
        if (layer->enabled > 0) rtcOccluded1(layer->top.get(), &context.embree, &query);
        if (query.tfar < 0.0f) return true;
    }
    return false;
}

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent) {
    ALEPH_CHECK(rays.size() == hits.size(), std::to_string(rays.size()) + " rays, " + std::to_string(hits.size()));
    if (state_.meshes->packet_width == 1) {  // Embree would split packets, and the filters would see one lane
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = intersect(rays[i]);
        return;
    }
    const PacketCounts counts = state_.meshes->packet_width == 16
                                    ? intersect_packets<16>(state_, blend_, rays, hits, coherent)
                                    : intersect_packets<8>(state_, blend_, rays, hits, coherent);
    traced_ += counts.traced;
    invalid_ += counts.invalid;
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    ALEPH_CHECK(rays.size() == blocked.size(),
                std::to_string(rays.size()) + " rays, " + std::to_string(blocked.size()));
    if (state_.meshes->packet_width == 1) {
        for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = occluded(rays[i]);
        return;
    }
    const PacketCounts counts = state_.meshes->packet_width == 16 ? occluded_packets<16>(state_, blend_, rays, blocked)
                                                                  : occluded_packets<8>(state_, blend_, rays, blocked);
    traced_ += counts.traced;
    invalid_ += counts.invalid;
}

}  // namespace aleph
