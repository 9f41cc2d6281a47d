#include "motion/raster_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "motion/reprojection.h"

namespace aleph {

MotionField compute_raster_motion(ModelMotion& model, const Scene& scene, const PosedView& now, const PosedView& other,
                                  const Image<Hit>& items, OtherFrame which) {
    MotionField field = model.compute(now, other, items, which);
    const double sign = displacement_sign(which), longest = std::hypot(items.width, items.height);
    const auto measure_from_center = [&](int x, int y) {
        const Hit& item = items(x, y);
        const auto [node, mesh] = now.pose.instances[item.instance];
        const CameraFromObject place = make_camera_from_object(now.view, now.pose.world[node]);
        const glm::dvec3 point = surface_point(scene.meshes[mesh], now.pose.meshes[mesh], item);
        const glm::dvec2 named = project_camera_point(now.view, place(point));
        glm::dvec2& displacement = field.displacement(x, y);
        displacement += sign * (named - glm::dvec2(x + 0.5, y + 0.5));
        const double length = glm::length(displacement);
        if (length > longest) displacement *= longest / length;
        field.path_length(x, y) = std::min(length, longest);
    };
    parallel_rows(items.height, 8, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < items.width; ++x) {
                const MotionValidity validity = field.validity(x, y);
                if (validity == MotionValidity::valid || validity == MotionValidity::leaves_screen)
                    measure_from_center(x, y);
            }
        }
    });
    return field;
}

}  // namespace aleph
