// Motion between equal poses: none, and valid where the surface is beyond the near plane.

#include "motion/still_motion.h"

#include <gtest/gtest.h>

#include "motion/model_motion.h"
#include "tests/support/motion_scenes.h"

namespace aleph {
namespace {

TEST(StillMotion, SurfacesBeforeTheNearPlaneAreBehindTheCamera) {
    for (const bool orthographic : {false, true}) {
        for (const double depth : {1.99, 2.01}) {
            Scene scene;
            add_camera(scene);
            scene.cameras[0].orthographic = orthographic;
            scene.cameras[0].near_plane = 2.0;
            scene.nodes[0].axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.7};
            const TwoViews views(scene, 0.0, 0.0, 32, 24);
            const CameraView& view = views.now.view;
            Image<Hit> hits(32, 24);
            for (int y = 0; y < 24; ++y) {
                for (int x = 1; x < 32; ++x) {
                    // In the plane at this depth; the nearest plane point is the middle's.
                    const double along = -(make_camera_ray(view, x + 0.5, y + 0.5).direction * view.axes).z;
                    hits(x, y) = {.instance = 0, .primitive = 0, .distance = static_cast<float>(depth / along)};
                }
            }
            const MotionField field = make_still_motion(view, hits);
            const MotionValidity expected = depth > 2.0 ? MotionValidity::valid : MotionValidity::behind_camera;
            for (int y = 0; y < 24; ++y) {
                EXPECT_EQ(field.validity(0, y), MotionValidity::background);
                for (int x = 1; x < 32; ++x) {
                    EXPECT_EQ(field.validity(x, y), expected) << orthographic << x << ' ' << y;
                    EXPECT_EQ(field.displacement(x, y), glm::dvec2(0.0));
                    EXPECT_EQ(field.path_length(x, y), 0.0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace aleph
