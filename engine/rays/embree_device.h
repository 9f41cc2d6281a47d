#pragma once
// Embree's device and handles. Embree reports errors to a callback and goes on; here they become exceptions.

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>

namespace aleph {

struct ReleaseEmbree {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;
using EmbreeGeometry = std::unique_ptr<RTCGeometryTy, ReleaseEmbree>;

/// Every function throws std::bad_alloc where Embree is out of memory, and std::runtime_error for its other errors.
class EmbreeDevice {
  public:
    /// @param configuration  Embree's, such as "isa=avx2"; null: what suits the processor
    explicit EmbreeDevice(const char* configuration = nullptr);
    ~EmbreeDevice();
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    RTCDevice handle() const { return device_; }

    EmbreeScene make_scene(RTCSceneFlags flags, RTCBuildQuality quality) const;
    EmbreeGeometry make_geometry(RTCGeometryType type) const;

    /// A buffer that Embree allocates, with the padding that its wide loads need.
    template <class T>
    std::span<T> make_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) const {
        return {static_cast<T*>(make_buffer(geometry, type, format, sizeof(T), count)), count};
    }

    /// Throws the first error that Embree has reported, on any thread, since the last check. To be called after
    /// functions of Embree that return nothing, such as rtcCommitScene.
    void check() const;

  private:
    static void keep_error(void* self, RTCError code, const char* text);
    void* make_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                      std::size_t count) const;
    [[noreturn]] void fail() const;

    RTCDevice device_;
    mutable std::atomic<bool> failed_{false};
    mutable std::mutex mutex_;  ///< of the error's code and text
    mutable RTCError code_ = RTC_ERROR_NONE;
    mutable std::string text_;
};

}  // namespace aleph
