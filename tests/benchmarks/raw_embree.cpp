#include "tests/benchmarks/raw_embree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "engine/base/flush_denormals.h"
#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr int lanes = 16;

void add_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), points);
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

std::size_t trace_singles(RTCScene scene, std::span<const RawRay> rays) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    std::size_t hits = 0;
    for (const RawRay& raw : rays) {
        if (raw.occlusion) {
            RTCRay ray = raw.ray;
            rtcOccluded1(scene, &context, &ray);
            hits += ray.tfar < 0.0f ? 1 : 0;
        } else {
            RTCRayHit ray{raw.ray, {}};
            ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &ray);
            hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
        }
    }
    return hits;
}

/// Packets that fill up, one for each kind of ray.
std::size_t trace_packets(RTCScene scene, bool coherent, std::span<const RawRay> rays) {
    RTCIntersectContext context;
    std::size_t hits = 0;
    std::array<std::array<RTCRay, lanes>, 2> waiting;
    std::array<int, 2> counts{};
    const auto flush = [&](int kind) {
        alignas(64) int valid[lanes];
        alignas(64) RTCRayHit16 packet{};
        for (int lane = 0; lane < lanes; ++lane) {
            valid[lane] = lane < counts[kind] ? -1 : 0;
            const RTCRay& ray = waiting[kind][std::min(lane, counts[kind] - 1)];
            packet.ray.org_x[lane] = ray.org_x, packet.ray.org_y[lane] = ray.org_y, packet.ray.org_z[lane] = ray.org_z;
            packet.ray.dir_x[lane] = ray.dir_x, packet.ray.dir_y[lane] = ray.dir_y, packet.ray.dir_z[lane] = ray.dir_z;
            packet.ray.tnear[lane] = ray.tnear, packet.ray.tfar[lane] = ray.tfar, packet.ray.mask[lane] = ~0u;
            packet.hit.geomID[lane] = packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcInitIntersectContext(&context);
        // With the coherent flag this Embree's occlusion packets can loop for ever over instances.
        context.flags =
            coherent && kind == 0 ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        if (kind == 1) {
            rtcOccluded16(valid, scene, &context, &packet.ray);
        } else {
            rtcIntersect16(valid, scene, &context, &packet);
        }
        for (int lane = 0; lane < counts[kind]; ++lane) {
            hits += (kind == 1 ? packet.ray.tfar[lane] < 0.0f : packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID);
        }
        counts[kind] = 0;
    };
    for (const RawRay& raw : rays) {
        const int kind = raw.occlusion ? 1 : 0;
        waiting[kind][counts[kind]++] = raw.ray;
        if (counts[kind] == lanes) flush(kind);
    }
    for (const int kind : {0, 1}) {
        if (counts[kind] > 0) flush(kind);
    }
    return hits;
}

}  // namespace

RawEmbree::RawEmbree(const Scene& scene, const ScenePose& frame, const glm::dvec3& origin) {
    const FlushDenormals flush;
    device_ = rtcNewDevice(nullptr);
    top_ = rtcNewScene(device_);
    rtcSetSceneFlags(top_, RTC_SCENE_FLAG_ROBUST);
    Mesh all;
    for (std::size_t i = 0; i < frame.instances.size(); ++i) {
        if (frame.shown[i] == 0) continue;
        const auto [node, index] = frame.instances[i];
        const Mesh& mesh = scene.meshes[index];
        const std::vector<glm::dvec3>& deformed = frame.meshes[index].positions;
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 p = deformed.empty() ? glm::dvec3(mesh.positions[v]) : deformed[v];
            all.positions.emplace_back(glm::dvec3(frame.world[node] * glm::dvec4(p, 1.0)) - origin);
        }
        for (const glm::uvec3& t : mesh.triangles) all.triangles.push_back(t + first);
    }
    add_mesh(device_, top_, all);
    rtcCommitScene(top_);
}

RawEmbree::~RawEmbree() {
    rtcReleaseScene(top_);
    rtcReleaseDevice(device_);
}

std::size_t RawEmbree::trace(const std::vector<RawRay>& rays, Packets packets) const {
    std::atomic<std::size_t> hits{0};
    parallel_for(rays.size(), std::size_t{1} << 14, [&](std::size_t begin, std::size_t end) {
        const std::span<const RawRay> part = std::span(rays).subspan(begin, end - begin);
        hits += packets == Packets::none ? trace_singles(top_, part)
                                         : trace_packets(top_, packets == Packets::coherent, part);
    });
    return hits;
}

}  // namespace aleph
