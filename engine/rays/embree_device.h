#pragma once
// Embree's device and handles. Embree reports errors to a callback and goes on; here they become exceptions.

#include <embree3/rtcore.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace aleph {

struct ReleaseEmbree {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;
using EmbreeBvh = std::unique_ptr<RTCBVHTy, ReleaseEmbree>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, ReleaseEmbree>;

/// Every function throws std::bad_alloc where Embree is out of memory, and std::runtime_error for its other errors.
class EmbreeDevice {
  public:
    /// With the kernels that suit the processor, or those of the environment variable ALEPH_ISA: sse4.2, avx, avx2 or
    /// avx512. Pictures do not depend on them.
    /// @throws InputError: ALEPH_ISA is something else
    EmbreeDevice();
    /// @param configuration  Embree's, such as "isa=avx2"
    explicit EmbreeDevice(const char* configuration);
    ~EmbreeDevice();

    RTCDevice handle() const { return device_; }

    EmbreeScene make_scene(RTCSceneFlags flags, RTCBuildQuality quality) const;
    EmbreeGeometry make_geometry() const;  ///< of boxes that call back

    EmbreeBvh make_bvh() const;

    /// Throws the first error that Embree has reported, on any thread, since the last check. To be called after
    /// functions of Embree that return nothing, such as rtcCommitScene.
    void check() const;

  private:
    static void keep_error(void* self, RTCError code, const char* text);
    [[noreturn]] void fail() const;

    RTCDevice device_;
    mutable std::atomic<bool> failed_{false};
    mutable std::mutex mutex_;  ///< of the error's code and text
    mutable RTCError code_ = RTC_ERROR_NONE;
    mutable std::string text_;
};

}  // namespace aleph
