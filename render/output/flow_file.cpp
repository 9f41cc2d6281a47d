#include "render/output/flow_file.h"

#include <bit>
#include <cstdint>
#include <string>

#include "engine/base/atomic_file.h"

namespace aleph {

namespace {

constexpr float unknown_flow = 1e10f;

void append(std::string& bytes, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

void append(std::string& bytes, float value) {
    append(bytes, std::bit_cast<std::uint32_t>(value));
}

}  // namespace

void write_flow(const std::filesystem::path& path, const MotionField& motion) {
    const Image<glm::dvec2>& field = motion.displacement;
    std::string bytes = "PIEH";
    bytes.reserve(12 + 8 * field.size());
    append(bytes, static_cast<std::uint32_t>(field.width));
    append(bytes, static_cast<std::uint32_t>(field.height));
    for (std::size_t i = 0; i < field.size(); ++i) {
        const MotionValidity validity = motion.validity.pixels[i];
        const bool known = validity != MotionValidity::behind_camera && validity != MotionValidity::no_counterpart;
        append(bytes, known ? static_cast<float>(field.pixels[i].x) : unknown_flow);
        append(bytes, known ? static_cast<float>(field.pixels[i].y) : unknown_flow);
    }
    write_file(path, bytes);
}

}  // namespace aleph
