#include "motion/still_motion.h"

#include "engine/base/index.h"
#include "engine/base/parallel.h"

namespace aleph {

MotionField make_still_motion(const CameraView& view, const Image<Hit>& hits) {
    MotionField field{Image<glm::dvec2>(hits.width, hits.height, glm::dvec2(0.0)),
                      Image<double>(hits.width, hits.height, 0.0),
                      Image<MotionValidity>(hits.width, hits.height, MotionValidity::background)};
    parallel_rows(hits.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < hits.width; ++x) {
                const Hit& hit = hits(x, y);
                if (hit.instance == no_index) continue;
                const CameraRay ray = make_camera_ray(view, x + 0.5, y + 0.5);
                const double depth = -(ray.direction * view.axes).z * hit.distance;
                field.validity(x, y) = depth > view.near_plane ? MotionValidity::valid : MotionValidity::behind_camera;
            }
        }
    });
    return field;
}

}  // namespace aleph
