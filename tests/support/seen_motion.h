#pragma once
// First hits of a camera, and their motion to another moment.

#include <algorithm>
#include <utility>

#include "tests/support/first_hits.h"
#include "tests/support/model_motion.h"

namespace aleph {

/// First hits and their motion to another moment.
struct SeenMotion {
    SeenMotion(const Scene& scene, PosedView seen, PosedView later)
        : now(std::move(seen)),
          other(std::move(later)),
          hits(cast_first_hits(scene, now)),
          motion(compute_model_motion(scene, now, other, hits)) {}
    /// @param from, to  s
    SeenMotion(const Scene& scene, double from, double to, int width, int height, int camera = 0)
        : SeenMotion(scene, make_posed_view(scene, from, camera, width, height),
                     make_posed_view(scene, to, camera, width, height)) {}

    PosedView now, other;
    Image<Hit> hits;
    MotionField motion;
};

/// Motion found against motion expected, pixels.
struct MotionErrors {
    std::size_t hits = 0;
    double worst = 0.0;    ///< largest difference
    double longest = 0.0;  ///< of the motion expected
};

/// @param find_ends  from a hit to the pair of its points at both times: world, m
template <class FindEnds>
MotionErrors find_motion_errors(const SeenMotion& seen, const FindEnds& find_ends) {
    const auto project = [](const CameraView& view, const glm::dvec3& point) {
        return project_camera_point(view, to_camera(view, point));
    };
    MotionErrors errors;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        if (seen.hits.pixels[i].instance == no_index) continue;
        const std::pair<glm::dvec3, glm::dvec3> ends = find_ends(seen.hits.pixels[i]);
        const glm::dvec2 expected = project(seen.other.view, ends.second) - project(seen.now.view, ends.first);
        ++errors.hits;
        errors.worst = std::max(errors.worst, glm::length(seen.motion.displacement.pixels[i] - expected));
        errors.longest = std::max(errors.longest, glm::length(expected));
    }
    return errors;
}

}  // namespace aleph
