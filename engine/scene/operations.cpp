#include "engine/scene/operations.h"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "engine/scene/transforms.h"

namespace aleph {
namespace {

using Kind = OperationStack::Kind;

/// Rodrigues; `axis` is unit.
glm::dmat4 rotate_about(const glm::dvec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), k = 1.0 - c;
    const auto [x, y, z] = std::array{axis.x, axis.y, axis.z};
    return {{c + k * x * x, k * x * y + s * z, k * x * z - s * y, 0.0},
            {k * x * y - s * z, c + k * y * y, k * y * z + s * x, 0.0},
            {k * x * z + s * y, k * y * z - s * x, c + k * z * z, 0.0},
            {0.0, 0.0, 0.0, 1.0}};
}

glm::dmat4 make_matrix(Kind kind, const double* channels) {
    glm::dmat4 m(1.0);
    switch (kind) {
        case Kind::translate:
            m[3] = {channels[0], channels[1], channels[2], 1.0};
            return m;
        case Kind::scale:
            for (int i = 0; i < 3; ++i) m[i][i] = channels[i];
            return m;
        case Kind::matrix:
            return glm::make_mat4(channels);
        case Kind::rotate: {
            const glm::dvec3 axis = safe_normalize(glm::dvec3(channels[0], channels[1], channels[2]));
            return axis == glm::dvec3(0.0) ? m : rotate_about(axis, channels[3]);
        }
        default:
            return rotate_about(glm::dvec3(kind == Kind::rotate_x, kind == Kind::rotate_y, kind == Kind::rotate_z),
                                channels[0]);
    }
}

}  // namespace

std::size_t channel_count(Kind kind) {
    constexpr std::array<std::size_t, 7> counts{3, 3, 16, 4, 1, 1, 1};  // in the order of Kind
    return counts[index_of(kind)];
}

std::size_t channel_count(const OperationStack& stack) {
    std::size_t count = 0;
    for (const Kind kind : stack.operations) count += channel_count(kind);
    return count;
}

std::size_t sample_count(const OperationStack& stack) {
    const std::size_t channels = channel_count(stack);
    return channels == 0 ? 0 : stack.channels.size() / channels;
}

glm::dmat4 evaluate(const OperationStack& stack, double seconds) {
    const std::size_t count = channel_count(stack);
    const std::size_t samples = sample_count(stack);
    if (samples == 0) return glm::dmat4(1.0);
    const SampleSpan span = find_samples(stack.sampling, samples, seconds);
    const double* channels = stack.channels.data() + span.floor * count;
    std::vector<double> between;
    if (span.floor != span.ceil) {
        const double* next = stack.channels.data() + span.ceil * count;
        between.reserve(count);
        for (std::size_t i = 0; i < count; ++i) between.push_back(std::lerp(channels[i], next[i], span.fraction));
        channels = between.data();
    }
    glm::dmat4 result(1.0);
    for (const Kind kind : stack.operations) {
        result = result * make_matrix(kind, channels);
        channels += channel_count(kind);
    }
    return result;
}

bool do_samples_differ(const OperationStack& stack, std::size_t first, std::size_t last) {
    const std::size_t count = channel_count(stack);
    for (std::size_t i = (first + 1) * count; i < (last + 1) * count; ++i)
        if (stack.channels[i] != stack.channels[i - count]) return true;
    return false;
}

}  // namespace aleph
