// The only calls that trace rays. Embree ends the process on a ray with a NaN (Debian's build), so every ray is checked
// first: an invalid one is counted and is a miss.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/base/errors.h"
#include "engine/rays/ray_scene.h"
#include "engine/rays/state.h"
#include "engine/rays/traversal.h"

namespace aleph {

namespace {

/// Directions that are shorter count as none.
constexpr float min_direction = 1e-30f;

/// Without branches: it is asked for every ray. NaN fails every comparison.
bool is_valid(const Ray& ray) {
    const auto fits = [](const glm::vec3& v) {
        return (std::abs(v.x) < max_ray_component) & (std::abs(v.y) < max_ray_component) &
               (std::abs(v.z) < max_ray_component);
    };
    const glm::vec3& d = ray.direction;
    return fits(ray.origin) & fits(ray.direction) & (ray.near >= 0.0f) & (ray.near < max_ray_component) &
           (ray.far >= ray.near) &
           ((std::abs(d.x) > min_direction) | (std::abs(d.y) > min_direction) | (std::abs(d.z) > min_direction));
}

Hit make_hit(const RayLane& lane) {
    if (lane.nearest.empty()) return {};
    const Crossing& met = lane.nearest.result();
    return {met.instance, static_cast<int>(met.primitive), met.u, met.v, static_cast<float>(met.distance)};
}

/// Traces the traversal's only ray.
void trace_lane(Traversal& traversal) {
    const RayScene::State& state = *traversal.state;
    RayLane& lane = traversal.lanes[0];
    if (state.meshes->flat.tree != nullptr && state.placed)
        trace_triangles(*state.meshes->flat.tree, lane.origin + state.flat_shift, lane.direction, traversal);
    for (const ObjectLayer* layer : state.layers()) {
        glm::dvec3 start;
        if (layer->enabled() == 0 || lane.blocked ||
            !enter_tree(layer->extent(), lane.origin, lane.direction, lane, lane.entry, start))
            continue;
        trace_single(layer->scene(), start, lane.direction, lane.entry, traversal);
    }
}

/// Traces a ray that has met something on, from there.
void trace_beyond(const RayScene::State& state, Blend blend, const Ray& ray, const Crossing& passed, RayLane& lane) {
    lane.set(ray);
    lane.near = std::max(lane.near, passed.distance * (1.0 - 2.0 * Nearest::tie));
    Traversal traversal(state, &lane, blend, false);
    traversal.passed = &passed;
    trace_lane(traversal);
}

/// Takes a ray that has met its nearest surface to the one that its number chooses. It stays one ray.
void show_chosen(const RayScene::State& state, Blend blend, const Ray& ray, RayLane& lane) {
    if (blend != Blend::random || !(ray.choice >= 0.0f)) return;
    double choice = ray.choice;
    while (!lane.nearest.empty()) {
        const Crossing met = lane.nearest.result();
        const double alpha = met.alpha;
        if (alpha >= 1.0 || choice < alpha) return;
        choice = (choice - alpha) / (1.0 - alpha);
        trace_beyond(state, blend, ray, met, lane);
    }
}

/// A packet on its way through the trees, one after the other.
/// @tparam Width  8 or 16
template <int Width>
class PacketTracer {
  public:
    PacketTracer(const RayScene::State& state, Blend blend) : state_(state), blend_(blend) {
        for (int i = 0; i < Width; ++i) {
            packet_.ray.time[i] = 0.0f;
            packet_.ray.mask[i] = ~0u;
            packet_.ray.id[i] = packet_.ray.flags[i] = 0;
        }
    }

    /// @param rays  at most Width; invalid ones are left out
    void trace(std::span<const Ray> rays) {
        count_ = static_cast<int>(rays.size());
        for (int i = 0; i < count_; ++i) {
            valid_[i] = is_valid(rays[i]);
            lanes_[i].set(rays[i]);
        }
        if (state_.meshes->flat.tree != nullptr && state_.placed) {
            const TriangleTree& tree = *state_.meshes->flat.tree;
            trace(tree.scene(), tree.extent(), state_.flat_shift, [](RayLane& lane, const glm::dvec3& start) {
                lane.local.set(start, lane.direction);
                return &lane.object_entry;
            });
        }
        for (const ObjectLayer* layer : state_.layers())
            if (layer->enabled() > 0)
                trace(layer->scene(), layer->extent(), glm::dvec3(0.0),
                      [](RayLane& lane, const glm::dvec3&) { return &lane.entry; });
    }

    RayLane& lane(std::size_t i) { return lanes_[i]; }
    int invalid() const { return static_cast<int>(std::count(valid_, valid_ + count_, false)); }

  private:
    /// @param shift    to the tree's coordinates, m
    /// @param prepare  prepare(lane, start) keeps what the callbacks need, and says where the entry is kept
    template <class Prepare>
    void trace(RTCScene scene, const TreeExtent& extent, const glm::dvec3& shift, const Prepare& prepare) {
        bool any = false;
        for (int i = 0; i < Width; ++i) {
            RayLane& lane = lanes_[i];
            Entry entry;
            glm::dvec3 start;
            active_[i] =
                i < count_ && valid_[i] && enter_tree(extent, lane.origin + shift, lane.direction, lane, entry, start)
                    ? -1
                    : 0;
            RTCRay ray{};
            if (active_[i] != 0) {
                any = true;
                *prepare(lane, start) = entry;
                set_embree_ray(start, lane.direction, lane, entry, ray);
            }
            packet_.ray.org_x[i] = ray.org_x;
            packet_.ray.org_y[i] = ray.org_y;
            packet_.ray.org_z[i] = ray.org_z;
            packet_.ray.dir_x[i] = ray.dir_x;
            packet_.ray.dir_y[i] = ray.dir_y;
            packet_.ray.dir_z[i] = ray.dir_z;
            packet_.ray.tnear[i] = ray.tnear;
            packet_.ray.tfar[i] = ray.tfar;
            packet_.hit.geomID[i] = packet_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        if (!any) return;
        Traversal traversal(state_, lanes_, blend_, false);
        if constexpr (Width == 8) {
            rtcIntersect8(active_, scene, &traversal.embree, &packet_);
        } else {
            rtcIntersect16(active_, scene, &traversal.embree, &packet_);
        }
    }

    const RayScene::State& state_;
    Blend blend_;
    int count_ = 0;
    bool valid_[Width];
    alignas(64) int active_[Width];
    alignas(64) std::conditional_t<Width == 8, RTCRayHit8, RTCRayHit16> packet_;
    RayLane lanes_[Width];
};

template <int Width>
std::uint64_t intersect_packets(const RayScene::State& state, Blend blend, std::span<const Ray> rays,
                                std::span<Hit> hits, std::span<glm::vec3> normals) {
    std::uint64_t invalid = 0;
    PacketTracer<Width> tracer(state, blend);
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
        const std::size_t count = std::min<std::size_t>(Width, rays.size() - begin);
        tracer.trace(rays.subspan(begin, count));
        invalid += static_cast<std::uint64_t>(tracer.invalid());
        for (std::size_t i = 0; i < count; ++i) {
            show_chosen(state, blend, rays[begin + i], tracer.lane(i));
            hits[begin + i] = make_hit(tracer.lane(i));
            if (!normals.empty() && !tracer.lane(i).nearest.empty())
                normals[begin + i] = tracer.lane(i).nearest.result().normal;
        }
    }
    return invalid;
}

}  // namespace

Tracer::Tracer(const RayScene& scene, Blend blend) : state_(*scene.state_), blend_(blend) {}

Tracer::~Tracer() {
    if (traced_ > 0) state_.rays_traced.fetch_add(traced_, std::memory_order_relaxed);
    if (invalid_ > 0) state_.invalid_rays.fetch_add(invalid_, std::memory_order_relaxed);
}

template <class Use>
bool Tracer::trace(const Ray& ray, bool occlusion, RayLane& lane, const Use& set_up) {
    if (!is_valid(ray)) {
        ++invalid_;
        return false;
    }
    ++traced_;
    lane.set(ray);
    Traversal traversal(state_, &lane, blend_, occlusion);
    set_up(traversal);
    trace_lane(traversal);
    return true;
}

Hit Tracer::intersect(const Ray& ray, glm::vec3* normal) {
    RayLane lane;
    if (!trace(ray, false, lane, [](Traversal&) {})) return {};
    show_chosen(state_, blend_, ray, lane);
    if (normal != nullptr && !lane.nearest.empty()) *normal = lane.nearest.result().normal;
    return make_hit(lane);
}

Hit Tracer::intersect_others(const Ray& ray) {
    RayLane lane;
    const bool traced = trace(ray, false, lane, [](Traversal& traversal) { traversal.attenuates = true; });
    return traced ? make_hit(lane) : Hit{};
}

Met Tracer::meet(const Ray& ray, const Met* last) {
    RayLane lane;
    Crossing passed{};
    if (last != nullptr) {
        passed.distance = last->hit.distance;
        passed.instance = last->hit.instance;
        passed.primitive = static_cast<unsigned>(last->hit.primitive);
        passed.back = last->back;
        passed.bordering = last->bordering;
    }
    const bool traced = trace(ray, false, lane, [&](Traversal& traversal) {
        if (last == nullptr) return;
        traversal.passed = &passed;
        lane.near = std::max(lane.near, passed.distance * (1.0 - 2.0 * Nearest::tie));
    });
    if (!traced || lane.nearest.empty()) return {};
    const Crossing& met = lane.nearest.result();
    return {make_hit(lane), met.alpha, met.back, met.bordering};
}

bool Tracer::has_blended() const {
    return state_.meshes->any_blended;
}

bool Tracer::occluded(const Ray& ray) {
    RayLane lane;
    return trace(ray, true, lane, [](Traversal&) {}) && lane.blocked;
}

float Tracer::transmittance(const Ray& ray, bool plain_only) {
    if (plain_only && !state_.meshes->any_plain) return 1.0f;
    RayLane lane;
    const bool traced = trace(ray, true, lane, [&](Traversal& traversal) {
        traversal.attenuates = true;
        traversal.plain_only = plain_only;
    });
    if (!traced) return 1.0f;
    return lane.blocked ? 0.0f : static_cast<float>(std::exp2(-0x1p-24 * static_cast<double>(lane.attenuation)));
}

void Tracer::intersect(std::span<const Ray> rays, std::span<Hit> hits, std::span<glm::vec3> normals) {
    ALEPH_CHECK(rays.size() == hits.size() && (normals.empty() || normals.size() == hits.size()),
                fmt::format("{} rays, {} hits, {} normals", rays.size(), hits.size(), normals.size()));
    const int width = state_.meshes->packet_width;
    if (width == 1) {
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits[i] = intersect(rays[i], normals.empty() ? nullptr : &normals[i]);
        return;
    }
    const std::uint64_t invalid = width == 16 ? intersect_packets<16>(state_, blend_, rays, hits, normals)
                                              : intersect_packets<8>(state_, blend_, rays, hits, normals);
    traced_ += rays.size() - invalid;
    invalid_ += invalid;
}

}  // namespace aleph
