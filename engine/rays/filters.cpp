#include "engine/rays/filters.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "engine/base/sampling.h"
#include "engine/rays/state.h"

namespace aleph {

namespace {

/// Distances this near each other, relatively, count as equal: about 30 roundings. Embree's single rays, packets and
/// processors differ by up to 1.8e-6 of a distance.
constexpr float tie = 0x1p-19f;

/// Instance and primitive of lane i of `count`.
std::pair<int, unsigned> identify(const MeshStructures& meshes, RTCHitN* hits, unsigned count, unsigned i) {
    return {meshes.instance_of(RTCHitN_instID(hits, count, i, 0), RTCHitN_geomID(hits, count, i)),
            RTCHitN_primID(hits, count, i)};
}

/// Whether the triangle that lane i hits shows its back to the ray. Both are in the object's space, or that of the flat
/// tree.
bool shows_back(RTCRayN* rays, RTCHitN* hits, unsigned count, unsigned i) {
    return RTCRayN_dir_x(rays, count, i) * RTCHitN_Ng_x(hits, count, i) +
               RTCRayN_dir_y(rays, count, i) * RTCHitN_Ng_y(hits, count, i) +
               RTCRayN_dir_z(rays, count, i) * RTCHitN_Ng_z(hits, count, i) >
           0.0f;
}

/// Whether the hit offered to lane i wins against the accepted one, which ties with it.
bool comes_first(const MeshStructures& meshes, const RTCFilterFunctionNArguments& offered, RTCHitN* accepted,
                 unsigned i) {
    const auto a = identify(meshes, offered.hit, offered.N, i), b = identify(meshes, accepted, offered.N, i);
    if (a.first != b.first) return a.first < b.first;
    const bool a_back = shows_back(offered.ray, offered.hit, offered.N, i);
    const bool b_back = shows_back(offered.ray, accepted, offered.N, i);
    if (a_back == b_back) return a.second < b.second;
    return b_back == (meshes.mirrored[static_cast<std::size_t>(a.first)] == 0);
}

constexpr float beyond = 1.0f + tie;

/// Lane i, which is valid.
void keep_lane(const RTCFilterFunctionNArguments& arguments, unsigned i) {
    FilterContext& context = *reinterpret_cast<FilterContext*>(arguments.context);
    const unsigned count = arguments.N;  // lane i of the packet is ray i of ours
    float& offered = RTCRayN_tfar(arguments.ray, count, i);
    if (!(offered * beyond < context.nearest[i])) {  // as a rule what was accepted before lies clearly farther
        const bool lost = RTCHitN_geomID(context.accepted, count, i) != RTC_INVALID_GEOMETRY_ID &&
                          (offered > context.nearest[i] * beyond ||
                           !comes_first(*context.common.state->meshes, arguments, context.accepted, i));
        if (lost) {
            context.nearest[i] = std::min(context.nearest[i], offered);
            arguments.valid[i] = 0;
            return;
        }
    }
    context.nearest[i] = std::min(context.nearest[i], offered);
    context.distance[i] = offered;
    // A little more than the hit: what ties with it must be offered too, whichever comes first.
    offered = std::min(context.nearest[i] * beyond, context.far[i]);
}

template <unsigned Width>
unsigned find_valid_lanes(const int* valid) {
    unsigned lanes = 0;
    for (unsigned i = 0; i < Width; ++i) lanes |= (valid[i] != 0 ? 1u : 0u) << i;
    return lanes;
}

/// Many valid lanes at a time are handled together. Rays that have parted are offered hits one by one.
template <unsigned Width>
void keep_in_packet(const RTCFilterFunctionNArguments& arguments) {
    FilterContext& context = *reinterpret_cast<FilterContext*>(arguments.context);
    int* const valid = arguments.valid;
    const unsigned lanes = find_valid_lanes<Width>(valid);
    if (std::popcount(lanes) > 3) {
        float* const offered = &RTCRayN_tfar(arguments.ray, Width, 0);
        int close = 0;
        for (unsigned i = 0; i < Width; ++i) close |= valid[i] & (offered[i] * beyond < context.nearest[i] ? 0 : -1);
        if (close == 0) {
            for (unsigned i = 0; i < Width; ++i) {
                const bool accept = valid[i] != 0;
                context.nearest[i] = accept ? offered[i] : context.nearest[i];
                context.distance[i] = accept ? offered[i] : context.distance[i];
                offered[i] = accept ? std::min(offered[i] * beyond, context.far[i]) : offered[i];
            }
            return;
        }
    }
    for (unsigned left = lanes; left != 0; left &= left - 1)
        keep_lane(arguments, static_cast<unsigned>(std::countr_zero(left)));
}

/// Uniform in [0, 1), of one ray at one surface.
float choose(std::uint64_t ray_key, const std::pair<int, unsigned>& surface) {
    const std::uint64_t place = std::uint64_t{static_cast<std::uint32_t>(surface.first)} << 32 | surface.second;
    return unit_float(static_cast<std::uint32_t>(mix_bits(ray_key + mix_bits(place + 0x9e3779b97f4a7c15ull)) >> 32));
}

std::uint64_t join_bits(float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
}

}  // namespace

RayContext::RayContext(const RayScene::State& of, Blend blend, bool coherent)
    : state(&of), random(blend == Blend::random && of.meshes->any_blended) {
    rtcInitIntersectContext(&embree);
    embree.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

void RayContext::make_keys(std::span<const Ray> rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::vec3 &o = rays[i].origin, &d = rays[i].direction;
        std::uint64_t key = mix_bits(join_bits(o.x, o.y) + 0x9e3779b97f4a7c15ull);
        key = mix_bits(key ^ join_bits(o.z, d.x));
        keys[i] = mix_bits(key ^ join_bits(d.y, d.z));
    }
}

FilterContext::FilterContext(const RayScene::State& state, Blend blend, bool coherent, void* hits)
    : common(state, blend, coherent), accepted(static_cast<RTCHitN*>(hits)) {
    nearest.fill(std::numeric_limits<float>::infinity());
}

void keep_lowest_of_nearest(const RTCFilterFunctionNArguments* arguments) {
    switch (arguments->N) {
        case 8:
            keep_in_packet<8>(*arguments);
            break;
        case 16:
            keep_in_packet<16>(*arguments);
            break;
        default:
            for (unsigned i = 0; i < arguments->N; ++i)
                if (arguments->valid[i] != 0) keep_lane(*arguments, i);
    }
}

void pass_holes(const RTCFilterFunctionNArguments* arguments) {
    const RayContext& context = *reinterpret_cast<const RayContext*>(arguments->context);
    const AlphaCutout& cutout = *static_cast<const AlphaCutout*>(arguments->geometryUserPtr);
    const float material_alpha = context.state->alpha[cutout.material];
    const bool random = context.random && cutout.blended;
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] == 0) continue;
        const float alpha = cutout.alpha_at(material_alpha, RTCHitN_primID(arguments->hit, count, i),
                                            RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i));
        const float least = random ? choose(context.keys[i], identify(*context.state->meshes, arguments->hit, count, i))
                                   : cutout.cutoff;
        // As a share, 0 lets every ray pass; as a mask, alpha at the cutoff is no hole (glTF 2.0, 3.9.4).
        if (random ? alpha <= least : alpha < least) arguments->valid[i] = 0;
    }
}

void keep_lowest_of_nearest_but_holes(const RTCFilterFunctionNArguments* arguments) {
    pass_holes(arguments);
    keep_lowest_of_nearest(arguments);
}

}  // namespace aleph
