#include "engine/rays/embree_device.h"

#include <fmt/format.h>

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>

#include "engine/base/errors.h"

namespace aleph {
namespace {

[[noreturn]] void throw_error(RTCError code, const std::string& text) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("Embree: {} (error {})", text, static_cast<int>(code)));
}

/// Empty: what suits the processor.
std::string read_kernels() {
    const char* const given = std::getenv("ALEPH_ISA");
    if (given == nullptr || *given == '\0') return "";
    for (const std::string_view known : {"sse4.2", "avx", "avx2", "avx512"})
        if (given == known) return fmt::format("isa={}", known);
    throw InputError("", "environment variable ALEPH_ISA",
                     fmt::format("\"{}\" is none of sse4.2, avx, avx2, avx512", printable(given)));
}

}  // namespace

EmbreeDevice::EmbreeDevice() : EmbreeDevice(read_kernels().c_str()) {}

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

EmbreeGeometry EmbreeDevice::make_geometry() const {
    EmbreeGeometry geometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER));
    if (geometry == nullptr) fail();
    return geometry;
}

EmbreeBvh EmbreeDevice::make_bvh() const {
    EmbreeBvh bvh(rtcNewBVH(device_));
    if (bvh == nullptr) fail();
    return bvh;
}

}  // namespace aleph
