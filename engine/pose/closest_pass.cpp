#include "engine/pose/closest_pass.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/bounds.h"
#include "engine/base/parallel.h"
#include "engine/pose/camera_view.h"
#include "engine/pose/parts.h"
#include "engine/scene/points.h"
#include "engine/scene/visit.h"

namespace aleph {
namespace {

struct Ball {
    glm::dvec3 center{0.0};  ///< m
    double radius = 0.0;
};

Ball ball_around(const std::vector<glm::vec3>& points) {
    Bounds bounds;
    for (const glm::vec3& p : points) bounds.add(p);
    return {0.5 * (bounds.low + bounds.high), 0.5 * glm::length(bounds.high - bounds.low)};
}

Ball ball_at(const PointCache& cache, const std::vector<Ball>& balls, double seconds) {
    const SampleSpan span = find_samples(cache.sampling, balls.size(), seconds);
    const Ball &a = balls[span.floor], &b = balls[span.ceil];
    return {glm::mix(a.center, b.center, span.fraction), std::lerp(a.radius, b.radius, span.fraction)};
}

bool is_in_view(const CameraView& view, const Ball& ball) {
    const glm::dvec2 low = unproject_pixel(view, 0.0, view.height), high = unproject_pixel(view, view.width, 0.0);
    const double depth = -ball.center.z;
    // How far the centre lies within a side of the picture.
    const auto within = [&](double place, double side) {
        return view.orthographic ? place - side : (place - side * depth) / std::sqrt(1.0 + side * side);
    };
    const double least = std::min({within(ball.center.x, low.x), -within(ball.center.x, high.x),
                                   within(ball.center.y, low.y), -within(ball.center.y, high.y)});
    return least >= -ball.radius && depth + ball.radius >= view.near_plane;
}

/// Smaller where the ball is larger in the picture; in it, where its centre is nearer.
double remoteness(const CameraView& view, const Ball& ball) {
    if (view.orthographic) return -ball.radius * view.pixels_per_unit;
    return (glm::length(ball.center) / ball.radius - 1.0) / view.pixels_per_unit;
}

/// The instances that are looked at, and the nodes that place them.
class Passes {
  public:
    Passes(const Scene& scene, int camera_node, std::span<const Instance> instances, int width, int height)
        : scene_(scene), camera_node_(camera_node), instances_(instances), width_(width), height_(height) {
        list_nodes();
        for (std::size_t i = 0; i < instances.size(); ++i)
            if (changes(instances[i])) changing_.push_back(i);
        for (const Cage& cage : scene.cages) {
            std::vector<Ball>& balls = balls_.emplace_back();
            if (cage.points == no_index) continue;
            for (const auto& sample : scene.point_caches[cage.points].positions) balls.push_back(ball_around(sample));
        }
    }

    /// Work for a frame, in units of about 10 ns.
    double cost() const {
        return 20.0 * static_cast<double>(nodes_.size()) + 4.0 * static_cast<double>(changing_.size());
    }
    bool is_empty() const { return changing_.empty(); }

    /// The closest passes among the frames first, first + stride, ... up to `last`.
    std::vector<std::optional<std::int64_t>> find(std::int64_t first, std::int64_t last, std::int64_t stride) const {
        constexpr std::size_t frames_per_chunk = 64;
        const auto count = static_cast<std::size_t>((last - first) / stride) + 1;
        std::vector<Nearest> chunks((count + frames_per_chunk - 1) / frames_per_chunk);
        const ScenePose start = place_nodes(scene_, scene_.film.frame_rate.seconds_of(first));
        parallel_for(count, frames_per_chunk, [&](std::size_t begin, std::size_t end) {
            Nearest& nearest = chunks[begin / frames_per_chunk];
            nearest.assign(changing_.size(), {});
            ScenePose posed = start;
            for (std::size_t i = begin; i < end; ++i) {
                place(first + static_cast<std::int64_t>(i) * stride, posed);
                look(posed, first + static_cast<std::int64_t>(i) * stride, nearest);
            }
        });
        std::vector<std::optional<std::int64_t>> frames(instances_.size());
        for (std::size_t c = 0; c < changing_.size(); ++c) {
            const auto best =
                std::ranges::min_element(chunks, {}, [&](const Nearest& nearest) { return nearest[c].remoteness; });
            if ((*best)[c].remoteness < never) frames[changing_[c]] = (*best)[c].frame;
        }
        return frames;
    }

  private:
    static constexpr double never = std::numeric_limits<double>::infinity();
    struct Near {
        double remoteness = never;
        std::int64_t frame = 0;
    };
    using Nearest = std::vector<Near>;  ///< as changing_

    /// Nodes that move, and that the camera or an instance hangs below.
    void list_nodes() {
        const auto count = scene_.nodes.size();
        std::vector<std::uint8_t> needed(count, 0);
        moving_.resize(count, 0);
        needed[camera_node_] = 1;
        for (const Instance& instance : instances_) needed[instance.node] = 1;
        for (std::size_t n = count; n-- > 0;) {
            const Node& node = scene_.nodes[n];
            if (needed[n] == 0) continue;
            for (const int above : {node.parent, space_of(scene_, node)})
                if (above != no_index) needed[above] = 1;
        }
        for (std::size_t n = 0; n < count; ++n) {
            const Node& node = scene_.nodes[n];
            if (needed[n] == 0) continue;
            moving_[n] = has_animated_tracks(node);
            for (const int above : {node.parent, space_of(scene_, node)})
                if (above != no_index) moving_[n] |= moving_[above];
            if (moving_[n] != 0) nodes_.push_back(static_cast<int>(n));
        }
    }

    bool changes(const Instance& instance) const {
        const Mesh& mesh = scene_.meshes[instance.mesh];
        const int points = scene_.cages[mesh.subdivision.cage].points;
        return moving_[instance.node] != 0 || moving_[camera_node_] != 0 || is_animated(mesh.present) ||
               has_animated_tracks(scene_.cameras[scene_.nodes[camera_node_].camera]) ||
               (points != no_index && scene_.point_caches[points].positions.size() > 1);
    }

    void place(std::int64_t frame, ScenePose& posed) const {
        posed.seconds = scene_.film.frame_rate.seconds_of(frame);
        for (const int node : nodes_) place_node(scene_, node, posed.seconds, posed);
    }

    void look(ScenePose& posed, std::int64_t frame, Nearest& nearest) const {
        const CameraView view = make_camera_view(
            scene_, pose_camera(scene_, camera_node_, posed.world[camera_node_], posed.seconds), width_, height_);
        posed.instances.resize(1);
        for (std::size_t c = 0; c < changing_.size(); ++c) {
            const Instance& instance = posed.instances[0] = instances_[changing_[c]];
            const glm::dmat4& world = posed.world[instance.node];
            const int cage = scene_.meshes[instance.mesh].subdivision.cage;
            if (balls_[cage].empty()) continue;
            Ball ball = ball_at(scene_.point_caches[scene_.cages[cage].points], balls_[cage], posed.seconds);
            ball.center = to_camera(view, glm::dvec3(world * glm::dvec4(ball.center, 1.0)));
            ball.radius *= std::sqrt(
                std::max({glm::dot(world[0], world[0]), glm::dot(world[1], world[1]), glm::dot(world[2], world[2])}));
            const double here = remoteness(view, ball);
            if (!(here < nearest[c].remoteness) || !is_in_view(view, ball) || !is_shown(scene_, posed, 0)) continue;
            nearest[c] = {here, frame};
        }
    }

    const Scene& scene_;
    const int camera_node_;
    const std::span<const Instance> instances_;
    const int width_, height_;
    std::vector<std::uint8_t> moving_;      ///< by node
    std::vector<int> nodes_;                ///< those to pose, parents first
    std::vector<std::size_t> changing_;     ///< instances that are not alike at all frames
    std::vector<std::vector<Ball>> balls_;  ///< by cage, around each sample of its points
};

}  // namespace

std::vector<std::optional<std::int64_t>> find_closest_passes(const Scene& scene, int camera_node,
                                                             std::span<const Instance> instances, int width,
                                                             int height) {
    const Passes passes(scene, camera_node, instances, width, height);
    if (passes.is_empty()) return std::vector<std::optional<std::int64_t>>(instances.size());
    constexpr double most_work = 2e8;
    const FrameRange range = frame_range(scene);
    const double frames = static_cast<double>(range.last) - static_cast<double>(range.first) + 1.0;
    const auto stride = static_cast<std::int64_t>(std::max(1.0, std::ceil(frames * passes.cost() / most_work)));
    return passes.find(range.first, range.last, stride);
}

}  // namespace aleph
