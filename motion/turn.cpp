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
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

constexpr int max_step_count = 512;

using aleph::turn_between;  // of rotations
double turn_between(double a, double b) {
    return std::abs(b - a);
}

/// Rotation part by Gram-Schmidt: without shear it is the polar one, and with shear near enough to count degrees.
glm::dquat rotation_of(const glm::dmat4& matrix) {
    glm::dmat3 axes(matrix);
    if (glm::determinant(axes) < 0.0) axes = -axes;
    const glm::dvec3 x = glm::normalize(axes[0]);
    const glm::dvec3 y = glm::normalize(axes[1] - glm::dot(axes[1], x) * x);
    const glm::dquat rotation = glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y)));
    const double length = glm::length(rotation);
    return std::isfinite(length) ? rotation / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
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

/// The samples that are used between two times, as a track. `make` reads a value from a sample's channels.
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

/// Sum of the turns of all operations, which is not less than their combined turn.
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
            // Only the angle is counted: an axis that changes is rare, and changes slowly.
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
    if (node.transform.operations) return turn_of_operations(*node.transform.operations, begin, end);
    if (node.transform.matrix) return turn_along(*node.transform.matrix, begin, end);
    if (node.transform.axis_rotation) return turn_along(node.transform.axis_rotation->angle, begin, end);
    return turn_along(node.transform.rotation, begin, end);
}

double turn_of_picture(const Environment& environment, double begin, double end) {
    if (environment.axis_rotation) return turn_along(environment.axis_rotation->angle, begin, end);
    return turn_along(environment.rotation, begin, end);
}

/// Returns whether the parent's transform does not apply.
bool is_detached(const Node& node, double begin, double end) {
    return evaluate(node.inherits, begin) == 0.0 && evaluate(node.inherits, end) == 0.0;
}

double step_time(double begin, double end, int step, int count) {
    return begin + (end - begin) * step / count;
}

}  // namespace

TurnFinder::TurnFinder(const Scene& scene, const PosePlan& plan)
    : scene_(scene),
      plan_(plan),
      total_(scene.nodes.size(), 0.0),
      shared_(scene.nodes.size(), 0.0),
      joints_(scene.nodes.size(), 0.0),
      carries_camera_(scene.nodes.size(), 0) {
    for (int node = 0; node < std::ssize(scene.nodes); ++node) {
        const std::vector<int>& meshes = scene.nodes[node].meshes;
        const bool skinned =
            std::ranges::any_of(meshes, [&](int mesh) { return scene.meshes[mesh].deformation.skin != no_index; });
        if (skinned) skinned_.push_back(node);
        if (skinned || (!meshes.empty() && plan.moving[node] != 0)) with_mesh_.push_back(node);
    }
}

void TurnFinder::find(int camera_node, double begin, double end) {
    if (begin > end) std::swap(begin, end);
    std::vector<int> carriers;
    for (int node = camera_node; node != no_index;) {
        carriers.push_back(node);
        carries_camera_[node] = 1;
        const Node& carrier = scene_.nodes[node];
        node = is_detached(carrier, begin, end) ? space_of(scene_, carrier) : carrier.parent;
    }
    for (const int n : plan_.nodes) {
        const Node& node = scene_.nodes[n];
        const int above = is_detached(node, begin, end) ? space_of(scene_, node) : node.parent;
        total_[n] = (above == no_index ? 0.0 : total_[above]) + turn_of_node(node, begin, end);
        shared_[n] = carries_camera_[n] != 0 ? total_[n] : (above == no_index ? 0.0 : shared_[above]);
    }
    camera_ = camera_node == no_index ? 0.0 : total_[camera_node];
    background_ = camera_ + turn_of_picture(scene_.environment, begin, end);
    for (const int node : carriers) carries_camera_[node] = 0;

    for (const int node : skinned_) {
        joints_[node] = 0.0;
        for (const int mesh : scene_.nodes[node].meshes) {
            const int skin = scene_.meshes[mesh].deformation.skin;
            if (skin == no_index) continue;
            for (const int joint : scene_.skins[skin].joints)
                joints_[node] = std::max(joints_[node], turn_against_camera(joint));
        }
    }
}

double TurnFinder::turn_against_camera(int node) const {
    return (total_[node] - shared_[node]) + (camera_ - shared_[node]);
}

double TurnFinder::of_node(int node) const {
    return std::max(turn_against_camera(node), joints_[node]);
}

double TurnFinder::largest() const {
    double most = background_;  // also of everything that cannot move
    for (const int node : with_mesh_) most = std::max(most, of_node(node));
    return most;
}

std::vector<double> TurnFinder::subdivide(int camera_node, double begin, double end, double max_turn) {
    const auto turn_within = [&](double from, double to) {
        find(camera_node, from, to);
        return largest();
    };
    // The allowance keeps equal parts of a steady spin from being split again by rounding.
    const double limit = max_turn * (1.0 + 1e-9);
    const double turn = turn_within(begin, end);
    if (!(turn > limit)) return {};
    int count = static_cast<int>(std::min<double>(std::ceil(turn / limit), max_step_count));
    const auto is_too_coarse = [&] {
        for (int step = 0; step < count; ++step) {
            if (turn_within(step_time(begin, end, step, count), step_time(begin, end, step + 1, count)) > limit)
                return true;
        }
        return false;
    };
    // A spin that speeds up or slows down needs shorter steps than its mean says.
    while (count < max_step_count && is_too_coarse()) count = std::min(2 * count, max_step_count);
    std::vector<double> times;
    for (int step = 1; step < count; ++step) times.push_back(step_time(begin, end, step, count));
    return times;
}

}  // namespace aleph
