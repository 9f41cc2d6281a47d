// Cost of motion and perception on one thread at 640x480, relative to casting the frame's first hits in packets, and to
// a plain copy of what each stage reads and writes. Prints a table of ratios. The scene is `pool`.

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "motion/image_motion.h"
#include "motion/reprojection.h"
#include "motion/velocity.h"
#include "perception/noise_threshold.h"
#include "perception/perception.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "tests/benchmarks/raw_embree.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/all_pixels.h"
#include "tests/support/first_hits.h"
#include "tests/support/model_motion.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

constexpr int width = 640, height = 480;

/// Everything that the stages read, made once.
struct Inputs {
    Scene scene;
    std::int64_t frame_number = 0;
    PosedView now, next;
    RayScene rays, other_rays;
    Image<Hit> hits;
    MotionField motion;
    Image<float> velocity;
    Image<Rgb> estimate, next_estimate;

    explicit Inputs(Scene from) : scene(std::move(from)), rays(scene), other_rays(rays.share_meshes()) {
        const FrameRange range = frame_range(scene);
        frame_number = range.first + (range.last - range.first) / 4;
        const int camera = CameraNames(scene).find("");
        now = make_posed_view(scene, scene.film.frame_rate.seconds_of(frame_number), camera, width, height);
        next = make_posed_view(scene, scene.film.frame_rate.seconds_of(frame_number + 1), camera, width, height);
        rays.update(now.pose, compute_anchor(now.view));
        other_rays.update(next.pose, compute_anchor(next.view));
        hits = cast_first_hits(rays, now.view);
        motion = compute_motion();
        velocity = compute_image_velocity(motion, {}, {});
        estimate = compute_estimate(hits, now.pose);
        next_estimate = compute_estimate(cast_first_hits(other_rays, next.view), next.pose);
    }
    MotionField compute_motion() const { return compute_model_motion(scene, now, next, hits); }
    /// A checker on every surface, a gradient behind: edges and texture enough for the maps of perception.
    Image<Rgb> compute_estimate(const Image<Hit>& seen, const ScenePose& frame) const {
        Image<Rgb> image(width, height);
        for (const auto [x, y] : all_pixels(width, height)) {
            const Hit& hit = seen(x, y);
            if (hit.instance == no_index) {
                image(x, y) = Rgb(0.3f, 0.4f, 0.6f) * (1.0f - 0.5f * static_cast<float>(y) / height);
                continue;
            }
            const Instance& instance = frame.instances[hit.instance];
            const glm::dvec3 p = surface_point(scene.meshes[instance.mesh], hit);
            const glm::dvec3 cell = glm::floor(8.0 * p + 0.5);
            const bool odd = std::fmod(std::abs(cell.x + cell.y + cell.z), 2.0) > 0.5;
            const float hue = 0.37f * static_cast<float>(hit.instance);
            image(x, y) = (odd ? 0.7f : 0.2f) * Rgb(0.6f + 0.4f * std::sin(hue), 0.6f + 0.4f * std::cos(hue), 0.5f);
        }
        return image;
    }
};

/// Rays of all pixels' centres, in blocks of 4 x 4.
std::vector<RawRay> make_raw_rays(const CameraView& view) {
    const glm::dvec3 anchor = compute_anchor(view);
    std::vector<RawRay> rays;
    for (int i = 0; i < width * height; ++i) {
        const int x = i / 16 * 4 % width + i % 4, y = i / 16 * 4 / width * 4 + i / 4 % 4;
        const CameraRay ray = make_camera_ray(view, x + 0.5, y + 0.5);
        const glm::vec3 o(ray.origin - anchor), d(ray.direction);
        rays.push_back({{o.x, o.y, o.z, 0.0f, d.x, d.y, d.z, 0.0f, Ray{}.far, ~0u, 0, 0}, false});
    }
    return rays;
}

/// Copies each image once: what a stage reads and writes, without its arithmetic.
template <class... Images>
std::function<void()> copy_all(const Images&... images) {
    return [&images..., targets = std::tuple<Images...>(images...)]() mutable {
        std::apply(
            [&](Images&... target) {
                (std::memcpy(target.pixels.data(), images.pixels.data(), images.size() * sizeof(images.pixels[0])),
                 ...);
            },
            targets);
    };
}

struct Stage {
    const char* name;
    std::function<void()> run;
    double demand = 0.0;              ///< times first hits; 0: none
    const Best* copy = nullptr;       ///< of what it reads and writes
    std::function<void()> prepare{};  ///< before each run, and not timed
    Best best{CLOCK_THREAD_CPUTIME_ID};
};

void run() {
    const Inputs in(load_scene(source_folder() / "scenes/pool/scene.json"));
    const RawEmbree raw(in.scene, in.now.pose, compute_anchor(in.now.view));
    const std::vector<RawRay> raw_rays = make_raw_rays(in.now.view);
    const CensusPyramid next_census = make_census_pyramid(in.next_estimate);
    const Image<float> luminance = compute_adaptation_luminance(in.estimate, {});
    const NoiseVisibility noise({}, {}, NoiseOverTime::fresh);
    MotionField field;
    Image<Rgb> estimate;
    const auto copy_motion =
        copy_all(in.hits, in.motion.displacement, in.motion.path_length, in.motion.validity, in.velocity);
    // In: estimate and velocity; out: Aleph map and saliency, floats like the velocity.
    const auto copy_perception = copy_all(in.estimate, in.velocity, in.velocity, in.velocity);
    Best motion_copy(CLOCK_THREAD_CPUTIME_ID), perception_copy(CLOCK_THREAD_CPUTIME_ID);
    const auto perceive = [&](const PerceptionSettings& settings) {
        return [&, settings] { compute_perception(in.estimate, in.velocity, {}, {}, settings); };
    };
    Stage stages[] = {
        {"raw_embree", [&] { raw.trace(raw_rays, RawEmbree::Packets::coherent); }},
        {"first_hits", [&] { cast_first_hits(in.rays, in.now.view); }},
        {"motion", [&] { compute_image_velocity(in.compute_motion(), {}, {}); }, 1.0, &motion_copy},
        {"motion_hidden", [&] { mark_hidden(field, in.scene, in.next, in.hits, in.other_rays); }, 0.0, nullptr,
         [&] { field = in.motion; }},
        // Two frames to a motion field; a sequence makes every pyramid once.
        {"image_motion", [&] { compute_image_motion(make_census_pyramid(in.estimate), next_census); }},
        {"perception_full", perceive({.grid = SaliencyGrid::full}), 8.0, &perception_copy},
        {"perception_center", perceive({.grid = SaliencyGrid::center}), 2.0, &perception_copy},
        {"perception_spatial", perceive({.guide = Guide::spatial}), 0.0, &perception_copy},
        {"perception_castle", perceive({.vision = &castle_vision()}), 0.0, &perception_copy},
        {"sanitize", [&] { sanitize_estimate(estimate); }, 0.0, nullptr, [&] { estimate = in.estimate; }},
        {"threshold", [&] { compute_threshold(in.velocity, compute_adaptation_luminance(in.estimate, {})); }},
        {"threshold_noise",
         [&] { compute_noise_threshold(noise, in.estimate, 100.0, luminance, in.velocity, in.velocity); }}};
    // Stages take turns, so that a disturbance does not hit one of them alone.
    for (int round = 0; round < 45; ++round) {
        motion_copy.time(copy_motion);
        perception_copy.time(copy_perception);
        for (Stage& stage : stages) {
            if (stage.prepare) stage.prepare();
            stage.best.time(stage.run);
        }
    }
    fmt::print("frame {}, {}x{}, one thread, best CPU time of the repetitions\n", in.frame_number, width, height);
    fmt::print("{:<20}{:>8}{:>14}{:>10}{:>10}\n", "stage", "ms", "x first hits", "at most", "x memcpy");
    for (const Stage& stage : stages) {
        fmt::print("{:<20}{:>8.2f}{:>14.2f}{:>10}{:>10}\n", stage.name, 1e3 * stage.best.least,
                   stage.best.least / stages[1].best.least,
                   stage.demand > 0.0 ? fmt::format("{:g}", stage.demand) : "-",
                   stage.copy != nullptr ? fmt::format("{:.2f}", stage.best.least / stage.copy->least) : "-");
    }
}

}  // namespace
}  // namespace aleph

int main() {
    const aleph::ThreadLimit one(1);
    aleph::run();
}
