#include "engine/rays/traversal.h"

#include <bit>
#include <cmath>

#include "engine/base/sampling.h"
#include "engine/rays/state.h"

namespace aleph {
namespace {

bool comes_first(const Crossing& a, const Crossing& b) {
    if (a.instance != b.instance) return a.instance < b.instance;
    if (a.back != b.back) return b.back;
    return a.primitive < b.primitive;
}

std::uint64_t join_bits(float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
}

/// Uniform in [0, 1), of one ray at one triangle.
float choose(const Ray& ray, int instance, std::uint32_t primitive) {
    const glm::vec3 &o = ray.origin, &d = ray.direction;
    std::uint64_t key = mix_bits(join_bits(o.x, o.y) + 0x9e3779b97f4a7c15ull);
    key = mix_bits(key ^ join_bits(o.z, d.x));
    key = mix_bits(key ^ join_bits(d.y, d.z));
    const std::uint64_t place = std::uint64_t{static_cast<std::uint32_t>(instance)} << 32 | primitive;
    return unit_float(static_cast<std::uint32_t>(mix_bits(key + mix_bits(place + 0x9e3779b97f4a7c15ull)) >> 32));
}

bool is_hole(const AlphaCutout& cutout, const Traversal& traversal, RayLane& lane, Crossing& at) {
    const float alpha = cutout.alpha_at(traversal.state->alpha[cutout.material], at.primitive, at.u, at.v);
    if (traversal.attenuates && cutout.plain && alpha < 1.0f) {
        const double halvings = alpha > 0.0f ? -static_cast<double>(std::log2(1.0f - alpha)) : 0.0;
        lane.attenuation += std::llround(0x1p24 * (at.bordering ? 0.5 : 1.0) * halvings);  // of two triangles half each
        return true;
    }
    if (traversal.plain_only) return true;
    // As a share, 0 lets every ray pass; as a mask, alpha at the cutoff is no hole (glTF 2.0, 3.9.4).
    if (!cutout.blended || traversal.blend == Blend::cutout) return alpha < cutout.cutoff;
    at.alpha = alpha;
    const bool weighed = traversal.blend == Blend::whole || lane.given->choice >= 0.0f;
    return alpha <= (weighed ? 0.0f : choose(*lane.given, at.instance, at.primitive));
}

/// 1 / a power of two, exactly.
double invert(double power) {
    return std::bit_cast<double>(0x7fe0000000000000u - std::bit_cast<std::uint64_t>(power));
}

/// The triangles of a block that a ray meets, holes aside.
template <class Take>
void test_block(const TriangleTree& tree, unsigned index, const Traversal& traversal, RayLane& lane, const Take& take) {
    const TriangleBlock& block = tree.block(index);
    BlockHits hits;
    const double start = lane.object_entry.start;
    if (!intersect_block(block, lane.local, lane.near - start, lane.limit() - start, hits)) return;
    for (int i = 0; i < TriangleBlock::size; ++i) {
        if (!hits.found[i]) continue;
        const TreePart& part = tree.part(block.part[i]);
        if (traversal.plain_only && part.cutout == nullptr) continue;
        const glm::dvec3 a = block.corner(i, 0);
        const glm::dvec3 normal = glm::cross(block.corner(i, 1) - a, block.corner(i, 2) - a);
        if (normal == glm::dvec3(0.0)) continue;  // no area
        const ShearedRay& ray = lane.local;
        const double along =
            (normal[ray.axis[0]] * ray.shear_x + normal[ray.axis[1]] * ray.shear_y + normal[ray.axis[2]]) *
            ray.inverse_z;
        Crossing crossing{start + hits.distance[i],
                          static_cast<float>(hits.u[i]),
                          static_cast<float>(hits.v[i]),
                          traversal.first_instance + part.instance,
                          block.primitive[i],
                          (along > 0.0) != part.mirrored,
                          hits.bordering[i],
                          glm::vec3(normal),
                          1.0f};
        if (traversal.passed != nullptr && !is_beyond(*traversal.passed, crossing)) continue;
        if (part.cutout != nullptr && is_hole(*part.cutout, traversal, lane, crossing)) continue;
        if (!take(crossing)) return;
    }
}

}  // namespace

void Nearest::offer_tie(const Crossing& crossing) {
    nearest_ = std::min(nearest_, crossing.distance);
    bool wanted = crossing.distance <= limit();
    int count = 0;
    for (int i = 0; i < count_; ++i) {
        const Crossing& other = kept_[i];
        const bool before = comes_first(other, crossing);
        if (other.distance > limit() || (!before && other.distance >= crossing.distance)) continue;
        if (before && other.distance <= crossing.distance) wanted = false;
        if (count != i) kept_[count] = other;
        ++count;
    }
    count_ = count;
    if (!wanted) return;
    if (count_ == capacity) {
        if (more_ == nullptr) more_ = std::make_unique<std::vector<Crossing>>();
        more_->push_back(kept_[0]);
        std::copy(kept_ + 1, kept_ + count_--, kept_);
    }
    int place = count_++;
    for (; place > 0 && kept_[place - 1].distance > crossing.distance; --place) kept_[place] = kept_[place - 1];
    kept_[place] = crossing;
}

const Crossing& Nearest::find_result() const {
    const Crossing* first = &kept_[count_ - 1];
    for (const Crossing& other : *more_)
        if (other.distance <= limit() && comes_first(other, *first)) first = &other;
    return *first;
}

bool is_beyond(const Crossing& passed, const Crossing& next) {
    if (next.distance * (1.0 + Nearest::tie) < passed.distance) return false;
    if (next.distance > passed.distance * (1.0 + Nearest::tie)) return true;
    const bool same_sheet =
        next.bordering && passed.bordering && next.instance == passed.instance && next.back == passed.back;
    return comes_first(passed, next) && !same_sheet;
}

void RayLane::set(const Ray& ray) {
    given = &ray;
    origin = ray.origin;
    direction = ray.direction;
    near = ray.near;
    far = ray.far;
    nearest.clear();
    blocked = false;
    attenuation = 0;
}

Traversal::Traversal(const RayScene::State& of, RayLane* rays, Blend blended, bool any_hit)
    : lanes(rays), state(&of), blend(blended), occlusion(any_hit) {
    rtcInitIntersectContext(&embree);
}

Traversal::Traversal(const Traversal& outer, RayLane& lane)
    : lanes(&lane),
      state(outer.state),
      blend(outer.blend),
      occlusion(outer.occlusion),
      attenuates(outer.attenuates),
      plain_only(outer.plain_only),
      passed(outer.passed) {
    rtcInitIntersectContext(&embree);
}

bool enter_tree(const TreeExtent& extent, const glm::dvec3& origin, const glm::dvec3& direction, const RayLane& lane,
                Entry& entry, glm::dvec3& start) {
    const glm::dvec3 size = glm::abs(direction);
    // The power of two below the longest component: Embree's ray gets a direction of about unit length.
    const std::uint64_t longest = std::bit_cast<std::uint64_t>(std::max({size.x, size.y, size.z}));
    entry = {0.0, std::bit_cast<double>(longest & 0x7ff0000000000000u)};
    start = origin;
    const glm::dvec3 to_center = extent.center - origin;
    const double distance = glm::dot(to_center, to_center);
    if (distance <= extent.reach() * extent.reach()) return true;
    const double inverse = invert(entry.unit);
    const glm::dvec3 way = inverse * direction;
    const double length = glm::dot(way, way), along = glm::dot(to_center, way) / length;
    const glm::dvec3 miss = to_center - along * way;
    const double radius = 1.05 * extent.radius, before = radius / std::sqrt(length);
    if (along <= 0.0 || glm::dot(miss, miss) > radius * radius + 1e-28 * distance) return false;
    if ((along - before) * inverse > lane.limit()) return false;
    start = origin + (along - 2.0 * before) * way;
    entry.start = (along - 2.0 * before) * inverse;
    return true;
}

float embree_far(const RayLane& lane, const Entry& entry) {
    return static_cast<float>((lane.limit() - entry.start) * entry.unit * (1.0 + 0x1p-20));
}

void set_embree_ray(const glm::dvec3& start, const glm::dvec3& direction, const RayLane& lane, const Entry& entry,
                    RTCRay& ray) {
    const auto as_float = [](double v) { return static_cast<float>(v); };
    const double inverse = invert(entry.unit);
    ray.org_x = as_float(start.x);
    ray.org_y = as_float(start.y);
    ray.org_z = as_float(start.z);
    ray.dir_x = as_float(direction.x * inverse);
    ray.dir_y = as_float(direction.y * inverse);
    ray.dir_z = as_float(direction.z * inverse);
    ray.tnear = as_float(std::max(0.0, (lane.near - entry.start) * entry.unit * (1.0 - 0x1p-20)));
    ray.tfar = std::max(0.0f, embree_far(lane, entry));
    ray.time = 0.0f;
    ray.mask = ~0u;
    ray.id = ray.flags = 0;
}

void trace_single(RTCScene scene, const glm::dvec3& start, const glm::dvec3& direction, const Entry& entry,
                  Traversal& traversal) {
    RTCRayHit query;
    set_embree_ray(start, direction, traversal.lanes[0], entry, query.ray);
    if (traversal.occlusion) {
        rtcOccluded1(scene, &traversal.embree, &query.ray);
    } else {
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &traversal.embree, &query);
    }
}

void trace_triangles(const TriangleTree& tree, const glm::dvec3& origin, const glm::dvec3& direction,
                     Traversal& traversal) {
    RayLane& lane = traversal.lanes[0];
    glm::dvec3 start;
    if (!enter_tree(tree.extent(), origin, direction, lane, lane.object_entry, start)) return;
    lane.local.set(start, direction);
    trace_single(tree.scene(), start, direction, lane.object_entry, traversal);
}

void intersect_blocks(const RTCIntersectFunctionNArguments* arguments) {
    const Traversal& traversal = *reinterpret_cast<const Traversal*>(arguments->context);
    const TriangleTree& tree = *static_cast<const TriangleTree*>(arguments->geometryUserPtr);
    RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        RayLane& lane = traversal.lanes[i];
        test_block(tree, arguments->primID, traversal, lane, [&](const Crossing& crossing) {
            lane.nearest.offer(crossing);
            RTCRayN_tfar(rays, arguments->N, i) = embree_far(lane, lane.object_entry);
            return true;
        });
    }
}

void occlude_blocks(const RTCOccludedFunctionNArguments* arguments) {
    const Traversal& traversal = *reinterpret_cast<const Traversal*>(arguments->context);
    const TriangleTree& tree = *static_cast<const TriangleTree*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        RayLane& lane = traversal.lanes[i];
        test_block(tree, arguments->primID, traversal, lane, [&](const Crossing&) {
            lane.blocked = true;
            RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
            return false;
        });
    }
}

}  // namespace aleph
