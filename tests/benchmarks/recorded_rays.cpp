#include "tests/benchmarks/recorded_rays.h"

#include <dlfcn.h>

namespace aleph {
namespace {

bool recording = false;
std::vector<RawRay> recorded;

RTCScene first_tree = nullptr;

void record(RTCScene tree, const RTCRay& ray, bool occlusion) {
    if (first_tree == nullptr) first_tree = tree;
    if (tree == first_tree) recorded.push_back({ray, occlusion});
}

/// @param rays  in a packet of this width
void record_packet(const int* valid, RTCScene tree, RTCRayN* rays, unsigned width, bool occlusion) {
    for (unsigned i = 0; recording && i < width; ++i) {
        if (valid[i] != 0) record(tree, rtcGetRayFromRayN(rays, width, i), occlusion);
    }
}

template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

std::vector<RawRay> record_rays(const std::function<void()>& run) {
    recorded.clear();
    first_tree = nullptr;
    recording = true;
    run();
    recording = false;
    return std::move(recorded);
}

glm::dvec3 origin_of_recorded(const RayScene& rays, const ScenePose& pose) {
    for (int i = 0; i < std::ssize(pose.instances); ++i) {
        if (rays.is_flat(i)) return rays.flat_origin();
    }
    return rays.anchor();
}

}  // namespace aleph

extern "C" {

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
    static auto* const call = aleph::original<decltype(rtcIntersect1)>("rtcIntersect1");
    if (aleph::recording) aleph::record(scene, ray->ray, false);
    call(scene, context, ray);
}

void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
    static auto* const call = aleph::original<decltype(rtcOccluded1)>("rtcOccluded1");
    if (aleph::recording) aleph::record(scene, *ray, true);
    call(scene, context, ray);
}

void rtcIntersect8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit8* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect8)>("rtcIntersect8");
    aleph::record_packet(valid, scene, reinterpret_cast<RTCRayN*>(&packet->ray), 8, false);
    call(valid, scene, context, packet);
}

void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect16)>("rtcIntersect16");
    aleph::record_packet(valid, scene, reinterpret_cast<RTCRayN*>(&packet->ray), 16, false);
    call(valid, scene, context, packet);
}

void rtcOccluded8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* packet) {
    static auto* const call = aleph::original<decltype(rtcOccluded8)>("rtcOccluded8");
    aleph::record_packet(valid, scene, reinterpret_cast<RTCRayN*>(packet), 8, true);
    call(valid, scene, context, packet);
}

void rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* packet) {
    static auto* const call = aleph::original<decltype(rtcOccluded16)>("rtcOccluded16");
    aleph::record_packet(valid, scene, reinterpret_cast<RTCRayN*>(packet), 16, true);
    call(valid, scene, context, packet);
}

}  // extern "C"
