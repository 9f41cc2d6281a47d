#include "tests/benchmarks/recorded_rays.h"

#include <dlfcn.h>

#include <algorithm>

namespace aleph {
namespace {

bool recording = false;
std::vector<RawRay> recorded;

bool is_same(const RawRay& a, const RawRay& b) {
    return a.ray.org_x == b.ray.org_x && a.ray.org_y == b.ray.org_y && a.ray.org_z == b.ray.org_z &&
           a.ray.dir_x == b.ray.dir_x && a.ray.dir_y == b.ray.dir_y && a.ray.dir_z == b.ray.dir_z &&
           a.occlusion == b.occlusion;
}

/// Rays go through what stands still and what moves one after the other: they count once.
void record(const RTCRay& ray, bool occlusion) {
    const RawRay entry{ray, occlusion};
    const std::size_t near = std::min<std::size_t>(recorded.size(), 17);
    for (std::size_t i = 0; i < near; ++i) {
        if (is_same(recorded[recorded.size() - 1 - i], entry)) return;
    }
    recorded.push_back(entry);
}

/// @param rays  in a packet of this width
void record_packet(const int* valid, RTCRayN* rays, unsigned width, bool occlusion) {
    for (unsigned i = 0; recording && i < width; ++i) {
        if (valid[i] != 0) record(rtcGetRayFromRayN(rays, width, i), occlusion);
    }
}

template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

std::vector<RawRay> record_rays(const std::function<void()>& run) {
    recorded.clear();
    recording = true;
    run();
    recording = false;
    return std::move(recorded);
}

}  // namespace aleph

extern "C" {

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
    static auto* const call = aleph::original<decltype(rtcIntersect1)>("rtcIntersect1");
    if (aleph::recording) aleph::record(ray->ray, false);
    call(scene, context, ray);
}

void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
    static auto* const call = aleph::original<decltype(rtcOccluded1)>("rtcOccluded1");
    if (aleph::recording) aleph::record(*ray, true);
    call(scene, context, ray);
}

void rtcIntersect8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit8* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect8)>("rtcIntersect8");
    aleph::record_packet(valid, reinterpret_cast<RTCRayN*>(&packet->ray), 8, false);
    call(valid, scene, context, packet);
}

void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect16)>("rtcIntersect16");
    aleph::record_packet(valid, reinterpret_cast<RTCRayN*>(&packet->ray), 16, false);
    call(valid, scene, context, packet);
}

void rtcOccluded8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* packet) {
    static auto* const call = aleph::original<decltype(rtcOccluded8)>("rtcOccluded8");
    aleph::record_packet(valid, reinterpret_cast<RTCRayN*>(packet), 8, true);
    call(valid, scene, context, packet);
}

void rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* packet) {
    static auto* const call = aleph::original<decltype(rtcOccluded16)>("rtcOccluded16");
    aleph::record_packet(valid, reinterpret_cast<RTCRayN*>(packet), 16, true);
    call(valid, scene, context, packet);
}

}  // extern "C"
