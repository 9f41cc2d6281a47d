#pragma once

#include "motion/model_motion.h"
#include "tests/support/first_hits.h"

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

}  // namespace aleph
