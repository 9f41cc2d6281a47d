#include "motion/turn.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

#include "engine/scene/operations.h"
#include "engine/scene/time_sampling.h"
#include "engine/scene/track.h"

namespace aleph {
namespace {

constexpr int largest_step_count = 512;

double turn_between(double a, double b) {
    return std::abs(b - a);
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat nearer = glm::dot(a, b) < 0.0 ? -b : b;
    return 4.0 * std::atan2(glm::length(a - nearer), glm::length(a + nearer));
}

/// Rotation part by Gram-Schmidt: without shear it is the polar one, and with shear near enough to count degrees.
glm::dquat rotation_of(const glm::dmat4& matrix) {
    glm::dmat3 axes(matrix);
    if (glm::determinant(axes) < 0.0) axes = -axes;
    const glm::dvec3 x = glm::normalize(axes[0]);
    const glm::dvec3 y = glm::normalize(axes[1] - glm::dot(axes[1], x) * x);
    const glm::dquat rotation = glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y)));
    const double length = glm::length(rotation);
    return std::isfinite(length) && length > 0.0 ? rotation / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

double turn_between(const glm::dmat4& a, const glm::dmat4& b) {
    return turn_between(rotation_of(a), rotation_of(b));
}

/// Sum of the turns along begin, the keys between, end. A step track jumps: it never passes through the angles between.
template <class T>
double turn_along(const Track<T>& track, double begin, double end) {
    const std::size_t count = track.key_count();
    if (count < 2 || track.interpolation == Interpolation::step) return 0.0;
    // Between two keys a spline may swing beyond both.
    const int pieces = track.interpolation == Interpolation::cubic ? 8 : 1;

    double sum = 0.0, time = begin;
    T value = evaluate(track, begin);
    const auto go_to = [&](double next) {
        for (int piece = 1; piece <= pieces; ++piece) {
            const T here = evaluate(track, piece == pieces ? next : time + (next - time) * piece / pieces);
            sum += turn_between(value, here);
            value = here;
        }
        time = next;
    };
    const std::size_t first = find_samples(track.sampling, count, begin).floor;
    const std::size_t last = find_samples(track.sampling, count, end).ceil;
    for (std::size_t key = first; key <= last; ++key) {
        const double at = sample_time(track.sampling, key);
        if (at > begin && at < end) go_to(at);
    }
    go_to(end);
    return sum;
}

/// The samples that matter between two times, as a track of their own. `make` reads a value from a sample's channels.
template <class T, class Make>
double turn_of_channels(const OperationStack& stack, const SampleSpan& used, double begin, double end,
                        const Make& make) {
    Track<T> track;
    track.sampling.kind = TimeSampling::Kind::acyclic;
    const std::size_t channels = channel_count(stack);
    for (std::size_t i = used.floor; i <= used.ceil; ++i) {
        track.sampling.times.push_back(sample_time(stack.sampling, i));
        track.values.push_back(make(stack.channels.data() + i * channels));
    }
    return turn_along(track, begin, end);
}

/// Turns of all operations added up: not less than what they do together.
double turn_of_operations(const OperationStack& stack, double begin, double end) {
    using Kind = OperationStack::Kind;
    const std::size_t samples = sample_count(stack);
    if (samples < 2) return 0.0;
    const SampleSpan used{find_samples(stack.sampling, samples, begin).floor,
                          find_samples(stack.sampling, samples, end).ceil, 0.0};
    double sum = 0.0;
    std::size_t first = 0;  // channel of the operation
    for (const Kind kind : stack.operations) {
        const std::size_t at = first;
        first += channel_count(kind);
        if (kind == Kind::rotate) {
            // An axis that swings is rare, and then slow: only the angle is counted.
            sum += turn_of_channels<double>(stack, used, begin, end, [&](const double* c) { return c[at + 3]; });
        } else if (kind == Kind::rotate_x || kind == Kind::rotate_y || kind == Kind::rotate_z) {
            sum += turn_of_channels<double>(stack, used, begin, end, [&](const double* c) { return c[at]; });
        } else if (kind == Kind::matrix) {
            sum += turn_of_channels<glm::dmat4>(stack, used, begin, end,
                                                [&](const double* c) { return glm::make_mat4(c + at); });
        }
    }
    return sum;
}

double turn_of_node(const Node& node, double begin, double end) {
    if (node.operations) return turn_of_operations(*node.operations, begin, end);
    if (node.matrix) return turn_along(*node.matrix, begin, end);
    if (node.axis_rotation) return turn_along(node.axis_rotation->angle, begin, end);
    return turn_along(node.rotation, begin, end);
}

/// Whether the parent's transform does not apply.
bool is_detached(const Node& node, double begin, double end) {
    return evaluate(node.inherits, begin) == 0.0 && evaluate(node.inherits, end) == 0.0;
}

double largest(const Scene& scene, const Turns& turns) {
    double most = turns.background;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].meshes.empty()) most = std::max(most, turns.nodes[i]);
    }
    return most;
}

double step_time(double begin, double end, int step, int count) {
    return begin + (end - begin) * step / count;
}

}  // namespace

Turns compute_turns(const Scene& scene, int camera_node, double begin, double end) {
    if (begin > end) std::swap(begin, end);
    std::vector<bool> carries_camera(scene.nodes.size(), false);
    for (int node = camera_node; node != no_index;) {
        carries_camera[node] = true;
        const Node& carrier = scene.nodes[node];
        node = is_detached(carrier, begin, end) ? no_index : carrier.parent;
    }
    // Along the way from the root: everything's turn, and the part of it that the camera shares.
    std::vector<double> total(scene.nodes.size(), 0.0), shared(scene.nodes.size(), 0.0);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const auto parent = static_cast<std::size_t>(node.parent);
        const bool is_root = node.parent == no_index;
        const bool detached = is_root || is_detached(node, begin, end);
        total[i] = (detached ? 0.0 : total[parent]) + turn_of_node(node, begin, end);
        shared[i] = carries_camera[i] ? total[i] : (detached ? 0.0 : shared[parent]);
    }
    Turns turns;
    turns.background = camera_node == no_index ? 0.0 : total[camera_node];
    turns.nodes.resize(scene.nodes.size());
    for (std::size_t i = 0; i < turns.nodes.size(); ++i) {
        turns.nodes[i] = (total[i] - shared[i]) + (turns.background - shared[i]);
    }
    // A skinned mesh turns with its joints, whatever its node does.
    const std::vector<double> of_nodes = turns.nodes;
    for (std::size_t i = 0; i < of_nodes.size(); ++i) {
        for (const int mesh : scene.nodes[i].meshes) {
            const int skin = scene.meshes[mesh].skin;
            if (skin == no_index) continue;
            for (const int joint : scene.skins[skin].joints) turns.nodes[i] = std::max(turns.nodes[i], of_nodes[joint]);
        }
    }
    return turns;
}

std::vector<double> subdivide_turns(const Scene& scene, int camera_node, double begin, double end, double largest_turn,
                                    double extra_turn) {
    const auto turn_within = [&](double from, double to, int count) {
        return largest(scene, compute_turns(scene, camera_node, from, to)) + extra_turn / count;
    };
    // The allowance keeps equal parts of a steady spin from being split again by rounding.
    const double limit = largest_turn * (1.0 + 1e-9);
    const double turn = turn_within(begin, end, 1);
    if (!(turn > limit)) return {};
    int count = static_cast<int>(std::min<double>(std::ceil(turn / limit), largest_step_count));
    const auto is_too_coarse = [&] {
        for (int step = 0; step < count; ++step) {
            const double from = step_time(begin, end, step, count), to = step_time(begin, end, step + 1, count);
            if (turn_within(from, to, count) > limit) return true;
        }
        return false;
    };
    // A spin that speeds up or slows down needs shorter steps than its mean says.
    while (count < largest_step_count && is_too_coarse()) count = std::min(2 * count, largest_step_count);
    std::vector<double> times;
    for (int step = 1; step < count; ++step) times.push_back(step_time(begin, end, step, count));
    return times;
}

}  // namespace aleph
