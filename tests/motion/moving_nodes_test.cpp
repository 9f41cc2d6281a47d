// Motion examines only the nodes that can move: the result has the same bits as when it examines all of them. Between
// equal poses there is none, and it is valid where the surface is beyond the near plane.

#include "motion/model_motion.h"
#include "tests/support/scenes/child_node.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int picture_width = 96, picture_height = 72;

Node spinning(Node node, double degrees_per_second) {
    node.transform.axis_rotation = AxisRotation{{0.0, 0.6, 0.8}, ramp(0.1, 0.1 + degrees_per_second * degrees)};
    return node;
}

int add_soup(Scene& scene, Node node) {
    node.meshes = {add_triangle_soup(scene, 50, 1.0f)};
    return add_node(scene, std::move(node));
}

/// Objects in front of a camera: some still, some turning fast, some below a turning node, one of them not inheriting.
Scene make_scene(double object_turn, double camera_turn) {
    Scene scene = make_skin_scene();  // its joints turn, its own node does not
    for (int i = 0; i < 5; ++i) add_soup(scene, child_of(no_index, {i - 2.0, 0.5, -9.0}));
    const int arm = add_node(scene, spinning(child_of(no_index, {0.0, 1.0, -8.0}), object_turn));
    add_soup(scene, child_of(arm, {1.0, 0.0, 0.0}));
    add_soup(scene, spinning(child_of(arm, {-1.0, 0.0, 0.0}), -2.0 * object_turn));
    Node let_go = child_of(arm, {0.0, 0.0, -12.0});
    let_go.inherits = 0.0;
    add_soup(scene, let_go);
    const int still = add_soup(scene, child_of(no_index, {0.3, -2.0, -7.0}));
    add_soup(scene, spinning(child_of(still, {0.0, -1.0, 0.0}), 40.0));
    // A turntable carries the camera and one object.
    const int table = add_node(scene, spinning(child_of(no_index, {0.0, 0.0, 3.0}), camera_turn));
    add_soup(scene, child_of(table, {0.2, 0.1, -6.0}));
    add_camera(scene, table);
    return scene;
}

TEST(MovingNodes, MotionHasTheBitsOfAPlanOfAllNodes) {
    for (const double object_turn : {5.0, 300.0, 4000.0}) {
        for (const double camera_turn : {0.0, 70.0}) {
            SCOPED_TRACE(object_turn);
            SCOPED_TRACE(camera_turn);
            const Scene scene = make_scene(object_turn, camera_turn);
            const PosePlan plan = make_pose_plan(scene), everything = make_pose_plan(scene, true);
            EXPECT_LT(plan.nodes.size(), everything.nodes.size());
            ModelMotion motion(scene, plan);
            for (const double seconds : {0.0, 0.5, 0.2}) {  // the result does not depend on earlier calls
                const TwoViews views(scene, seconds, seconds + 0.3, picture_width, picture_height);
                Image<Hit> hits = make_random_hits(scene, views.now.pose, picture_width, picture_height);
                hits(0, 0) = {};
                const MotionField field = motion.compute(views.now, views.other, hits);
                expect_same_field(field, ModelMotion(scene, everything).compute(views.now, views.other, hits));
                double detour = 0.0;
                for (std::size_t i = 0; i < hits.size(); ++i) {
                    const double chord = glm::length(field.displacement.pixels[i]);
                    detour = std::max(detour, field.path_length.pixels[i] - chord);
                }
                EXPECT_EQ(detour > 1.0, object_turn > 100.0);  // a fast turn is followed step by step
            }
        }
    }
}

TEST(StillMotion, SurfacesBeforeTheNearPlaneAreBehindTheCamera) {
    for (const bool orthographic : {false, true}) {
        for (const double depth : {1.99, 2.01}) {
            Scene scene;
            add_camera(scene);
            scene.cameras[0].orthographic = orthographic;
            scene.cameras[0].near_plane = 2.0;
            scene.nodes[0].transform.axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.7};
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
