#include "engine/rays/embree_device.h"

#include <fmt/format.h>

#include <new>
#include <stdexcept>

namespace aleph {
namespace {

[[noreturn]] void throw_error(RTCError code, const std::string& text) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("Embree: {} (error {})", text, static_cast<int>(code)));
}

}  // namespace

EmbreeDevice::EmbreeDevice(const char* configuration) : device_(rtcNewDevice(configuration)) {
    if (device_ == nullptr) throw_error(rtcGetDeviceError(nullptr), "cannot start on this machine");
    rtcSetDeviceErrorFunction(device_, keep_error, this);
}

EmbreeDevice::~EmbreeDevice() {
    rtcSetDeviceErrorFunction(device_, nullptr, nullptr);  // handles may outlive this
    rtcReleaseDevice(device_);
}

void EmbreeDevice::keep_error(void* self, RTCError code, const char* text) {
    const EmbreeDevice& device = *static_cast<const EmbreeDevice*>(self);
    const std::lock_guard lock(device.mutex_);
    if (device.failed_) return;  // what follows from the first error explains nothing
    device.code_ = code;
    device.text_ = text != nullptr ? text : "";
    device.failed_ = true;
}

void EmbreeDevice::fail() const {
    std::string text;
    RTCError code = RTC_ERROR_UNKNOWN;
    {
        const std::lock_guard lock(mutex_);
        if (failed_) {
            code = code_;
            text = std::move(text_);
        }
        failed_ = false;
    }
    throw_error(code, text);
}

void EmbreeDevice::check() const {
    if (failed_) fail();
}

EmbreeScene EmbreeDevice::make_scene(RTCSceneFlags flags, RTCBuildQuality quality) const {
    EmbreeScene scene(rtcNewScene(device_));
    if (scene == nullptr) fail();
    rtcSetSceneFlags(scene.get(), flags);
    rtcSetSceneBuildQuality(scene.get(), quality);
    return scene;
}

EmbreeGeometry EmbreeDevice::make_geometry(RTCGeometryType type) const {
    EmbreeGeometry geometry(rtcNewGeometry(device_, type));
    if (geometry == nullptr) fail();
    return geometry;
}

void* EmbreeDevice::make_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                                std::size_t count) const {
    void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
    if (buffer == nullptr) fail();
    return buffer;
}

}  // namespace aleph
