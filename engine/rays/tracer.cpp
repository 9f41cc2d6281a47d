// The only calls that trace rays. Embree ends the process on a ray with a NaN (Debian's build), so every ray is checked
// first: an invalid one is counted and is a miss.

#include <fmt/format.h>

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
glm::vec3 embree_direction(const glm::vec3& direction) {
    const auto clean = [](float v) { return std::abs(v) < 1e-30f ? 0.0f : v; };
    return {clean(direction.x), clean(direction.y), clean(direction.z)};
}

/// Without branches: it is asked for every ray. NaN fails every comparison.
bool is_valid(const Ray& ray) {
    const auto fits = [](const glm::vec3& v) {
        return (std::abs(v.x) < max_ray_component) & (std::abs(v.y) < max_ray_component) &
               (std::abs(v.z) < max_ray_component);
    };
    const glm::vec3 d = embree_direction(ray.direction);
    return fits(ray.origin) & fits(ray.direction) & (ray.near >= 0.0f) & (ray.near < max_ray_component) &
           (ray.far >= ray.near) & ((d.x != 0.0f) | (d.y != 0.0f) | (d.z != 0.0f));
}

/// Traces rays through the flat tree and the layers, one after the other, until trace(tree) returns false.
/// @param place  place(shift) moves the origins of the rays to the coordinates of the next tree, m
template <class Place, class Trace>
void visit_trees(const RayScene::State& state, const Place& place, const Trace& trace) {
    if (RTCScene flat = state.meshes->flat_scene.get(); flat != nullptr && state.placed) {
        place(state.flat_shift);
        if (!trace(flat)) return;
    }
    if (state.still.enabled + state.moving.enabled == 0) return;
    place(glm::vec3(0.0f));
    for (const Layer* layer : state.layers())
        if (layer->enabled > 0 && !trace(layer->top.get())) return;
}

Hit make_hit(const MeshStructures& meshes, unsigned object, unsigned geometry, unsigned primitive, float u, float v,
             float distance) {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
    return {meshes.instance_of(object, geometry), static_cast<int>(primitive), u, v, distance};
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

/// Origins of a packet's rays, relative to the anchor.
template <int Width>
struct alignas(64) Origins {
    float x[Width], y[Width], z[Width];

    template <class Rays>
    void place(const glm::vec3& shift, Rays& packet) const {
        for (int lane = 0; lane < Width; ++lane) {
            packet.org_x[lane] = x[lane] + shift.x;
            packet.org_y[lane] = y[lane] + shift.y;
            packet.org_z[lane] = z[lane] + shift.z;
        }
    }
};

/// Fills a packet but for the origins; invalid rays are switched off.
/// @param rays  as many as there are lanes; those from `present` on are switched off too
template <int Width, class Rays>
void fill(const Ray* rays, int present, Rays& packet, Origins<Width>& origins, int* valid, PacketCounts& counts) {
    for (int lane = 0; lane < Width; ++lane) {
        const Ray& ray = rays[lane];
        const glm::vec3 direction = embree_direction(ray.direction);
        origins.x[lane] = ray.origin.x;
        origins.y[lane] = ray.origin.y;
        origins.z[lane] = ray.origin.z;
        packet.dir_x[lane] = direction.x;
        packet.dir_y[lane] = direction.y;
        packet.dir_z[lane] = direction.z;
        packet.tnear[lane] = ray.near;
        packet.tfar[lane] = ray.far;
    }
    int good_count = 0;
    for (int lane = 0; lane < Width; ++lane) {
        const bool good = is_valid(rays[lane]) & (lane < present);
        good_count += good ? 1 : 0;
        valid[lane] = good ? -1 : 0;
    }
    for (int lane = 0; good_count < Width && lane < Width; ++lane) {
        if (valid[lane] != 0) continue;
        origins.x[lane] = origins.y[lane] = origins.z[lane] = packet.tnear[lane] = 0.0f;
        packet.dir_x[lane] = packet.dir_y[lane] = packet.dir_z[lane] = 0.0f;
        packet.tfar[lane] = std::numeric_limits<float>::infinity();
    }
    counts.traced += static_cast<std::uint64_t>(good_count);
    counts.invalid += static_cast<std::uint64_t>(present - good_count);
}

/// The same for a last packet that is not full.
template <int Width, class Rays>
void fill(std::span<const Ray> rays, Rays& packet, Origins<Width>& origins, int* valid, PacketCounts& counts) {
    if (rays.size() == Width) return fill<Width>(rays.data(), Width, packet, origins, valid, counts);
    std::array<Ray, Width> padded;
    std::copy(rays.begin(), rays.end(), padded.begin());
    fill<Width>(padded.data(), static_cast<int>(rays.size()), packet, origins, valid, counts);
}

/// What no ray of ours changes.
template <int Width, class Rays>
void fill_constants(Rays& packet) {
    for (int lane = 0; lane < Width; ++lane) {
        packet.time[lane] = 0.0f;
        packet.mask[lane] = ~0u;
        packet.id[lane] = static_cast<unsigned>(lane);
        packet.flags[lane] = 0;
    }
}

template <int Width>
PacketCounts intersect_packets(const RayScene::State& state, Blend blend, std::span<const Ray> all, std::span<Hit> hits,
                               std::span<glm::vec3> normals, bool coherent) {
    PacketCounts counts;
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::RayHits packet;
    Origins<Width> origins;
    fill_constants<Width>(packet.ray);
    for (std::size_t begin = 0; begin < all.size(); begin += Width) {
        const std::span<const Ray> rays = all.subspan(begin, std::min<std::size_t>(Width, all.size() - begin));
        fill<Width>(rays, packet.ray, origins, valid, counts);
        for (int lane = 0; lane < Width; ++lane)
            packet.hit.geomID[lane] = packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        FilterContext context(state, blend, coherent, &packet.hit);
        context.common.set_rays(rays);
        std::copy_n(packet.ray.tfar, Width, context.far.begin());
        visit_trees(
            state, [&](const glm::vec3& shift) { origins.place(shift, packet.ray); },
            [&](RTCScene tree) {
                Packet<Width>::intersect(valid, tree, &context.common.embree, &packet);
                return true;
            });
        for (std::size_t lane = 0; lane < rays.size(); ++lane) {
            hits[begin + lane] =
                make_hit(*state.meshes, packet.hit.instID[0][lane], packet.hit.geomID[lane], packet.hit.primID[lane],
                         packet.hit.u[lane], packet.hit.v[lane], context.distance[lane]);
        }
        for (std::size_t lane = 0; begin + lane < normals.size() && lane < Width; ++lane)
            normals[begin + lane] = {packet.hit.Ng_x[lane], packet.hit.Ng_y[lane], packet.hit.Ng_z[lane]};
    }
    return counts;
}

template <int Width>
PacketCounts occluded_packets(const RayScene::State& state, Blend blend, std::span<const Ray> all,
                              std::span<std::uint8_t> blocked) {
    PacketCounts counts;
    // Never "coherent": with that flag this Embree's occlusion packets can loop for ever over instances.
    RayContext context(state, blend, false);
    alignas(64) int valid[Width];
    alignas(64) typename Packet<Width>::Rays packet;
    Origins<Width> origins;
    fill_constants<Width>(packet);
    for (std::size_t begin = 0; begin < all.size(); begin += Width) {
        const std::span<const Ray> rays = all.subspan(begin, std::min<std::size_t>(Width, all.size() - begin));
        fill<Width>(rays, packet, origins, valid, counts);
        context.set_rays(rays);
        visit_trees(
            state, [&](const glm::vec3& shift) { origins.place(shift, packet); },
            [&](RTCScene tree) {
                Packet<Width>::occluded(valid, tree, &context.embree, &packet);
                int open = 0;  // a ray that is stopped has a negative end and is over
                for (int lane = 0; lane < Width; ++lane) {
                    valid[lane] = packet.tfar[lane] < 0.0f ? 0 : valid[lane];
                    open |= valid[lane];
                }
                return open != 0;
            });
        for (std::size_t lane = 0; lane < rays.size(); ++lane) blocked[begin + lane] = packet.tfar[lane] < 0.0f;
    }
    return counts;
}

RTCRay make_ray(const Ray& ray) {
    const glm::vec3 direction = embree_direction(ray.direction);
    return {ray.origin.x, ray.origin.y, ray.origin.z, ray.near, direction.x, direction.y,
            direction.z,  0.0f,         ray.far,      ~0u,      0,           0};
}

void place_origin(const glm::vec3& origin, RTCRay& ray) {
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
}

}  // namespace

Tracer::Tracer(const RayScene& scene, Blend blend) : state_(*scene.state_), blend_(blend) {}

Tracer::~Tracer() {
    if (traced_ > 0) state_.rays_traced.fetch_add(traced_, std::memory_order_relaxed);
    if (invalid_ > 0) state_.invalid_rays.fetch_add(invalid_, std::memory_order_relaxed);
}

Hit Tracer::intersect(const Ray& ray, glm::vec3* normal) {
    if (!is_valid(ray)) {
        ++invalid_;
        return {};
    }
    ++traced_;
    RTCRayHit query{make_ray(ray), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    FilterContext context(state_, blend_, false, &query.hit);
    context.common.set_rays({&ray, 1});
    context.far[0] = ray.far;
    visit_trees(
        state_, [&](const glm::vec3& shift) { place_origin(ray.origin + shift, query.ray); },
        [&](RTCScene tree) {
            rtcIntersect1(tree, &context.common.embree, &query);
            return true;
        });
    if (normal != nullptr) *normal = {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
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
    RTCRay query = make_ray(ray);
    visit_trees(
        state_, [&](const glm::vec3& shift) { place_origin(ray.origin + shift, query); },
        [&](RTCScene tree) {
            rtcOccluded1(tree, &context.embree, &query);
            return query.tfar >= 0.0f;
        });
    return query.tfar < 0.0f;
}

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent, std::span<glm::vec3> normals) {
    ALEPH_CHECK(rays.size() == hits.size() && (normals.empty() || normals.size() == hits.size()),
                fmt::format("{} rays, {} hits, {} normals", rays.size(), hits.size(), normals.size()));
    if (state_.meshes->packet_width == 1) {  // Embree would split packets, and the filters would see one lane
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits[i] = intersect(rays[i], normals.empty() ? nullptr : &normals[i]);
        return;
    }
    const PacketCounts counts = state_.meshes->packet_width == 16
                                    ? intersect_packets<16>(state_, blend_, rays, hits, normals, coherent)
                                    : intersect_packets<8>(state_, blend_, rays, hits, normals, coherent);
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
