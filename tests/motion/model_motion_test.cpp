// Model-based motion (thesis 5.1.2) against long-double truth at the hit's own (primitive, u, v), and what must be
// exact.

#include <ostream>

#include "tests/support/model_motion.h"
#include "tests/support/motion_truth.h"
#include "tests/support/scenes/child_node.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 96, height = 72;

struct Moving {
    const char* name;
    /// Adds nodes below `root`; returns the node that holds the camera.
    std::function<int(Scene&, int root)> build;
};
void PrintTo(const Moving& moving, std::ostream* out) {
    *out << moving.name;
}

Node with_spin(Node node, const glm::dvec3& axis, double from_degrees, double degrees_per_frame) {
    node.transform.axis_rotation = AxisRotation{
        glm::normalize(axis), ramp(from_degrees * degrees, (from_degrees + 30.0 * degrees_per_frame) * degrees)};
    return node;
}

int add_object(Scene& scene, Node node) {
    node.meshes = {add_triangle_soup(scene, 200, 1.0f)};
    return add_node(scene, std::move(node));
}

int translating(Scene& scene, int root) {
    Node node = child_of(root, {});
    node.transform.translation = ramp(glm::dvec3(-1.0, 0.3, -8.0), glm::dvec3(5.0, -2.0, -11.0));
    add_object(scene, node);
    return add_camera(scene, root);
}

int spinning(Scene& scene, int root) {
    add_object(scene, with_spin(child_of(root, {0.2, 0.1, -9.0}), {1.0, 2.0, -0.5}, 13.0, 170.0));
    return add_camera(scene, root);
}

int turning_by_quaternions(Scene& scene, int root) {
    Node node = child_of(root, {0.4, -0.3, -7.0});
    node.transform.rotation = ramp(glm::normalize(glm::dquat(0.9, 0.1, -0.4, 0.2)),
                                   glm::normalize(glm::dquat(-0.2, 0.7, 0.6, -0.3)), 0.0, 0.9);
    add_object(scene, node);
    return add_camera(scene, root);
}

/// Nine levels with non-uniform and mirroring scales, matrices and spins between, and objects on three of them.
int deep(Scene& scene, int root) {
    int parent = add_node(scene, child_of(root, {0.0, 0.0, -12.0}));
    for (int level = 0; level < 9; ++level) {
        Node node = with_spin(child_of(parent, {0.2 - 0.05 * level, 0.1, 0.07 * level}),
                              {0.3, 1.0 - 0.2 * level, 0.1 * level}, 10.0 * level, 4.0 - level);
        const double mirror = level % 3 == 1 ? -1.0 : 1.0;
        node.transform.scale = ramp(glm::dvec3(1.1 * mirror, 0.8, 1.3), glm::dvec3(0.9 * mirror, 1.2, 1.0));
        if (level == 4) {
            node.transform.matrix =
                glm::dmat4(1.1, 0.2, 0.0, 0.0, -0.3, -0.9, 0.1, 0.0, 0.0, 0.4, 1.0, 0.0, 0.1, 0.2, -0.3, 1.0);
        }
        if (level % 3 == 2) node.meshes = {add_triangle_soup(scene, 50, 0.8f)};
        parent = add_node(scene, std::move(node));
    }
    return add_camera(scene, root);
}

int camera_in_place(Scene& scene, int root, Node camera_mount) {
    add_object(scene, child_of(root, {0.5, 0.2, -6.0}));
    add_object(scene, with_spin(child_of(root, {-2.0, 1.0, -15.0}), {0.0, 1.0, 0.0}, 30.0, 0.0));
    camera_mount.parent = root;
    return add_camera(scene, add_node(scene, std::move(camera_mount)));
}

int panning(Scene& scene, int root) {
    return camera_in_place(scene, root, with_spin(child_of(root, {0.1, 0.2, 1.0}), {0.1, 1.0, 0.0}, -1.0, 2.0));
}
int dollying(Scene& scene, int root) {
    Node mount{.transform = {.translation = ramp(glm::dvec3(0.0, 0.5, 2.0), glm::dvec3(8.0, -3.0, -7.0))}};
    return camera_in_place(scene, root, mount);
}
int rolling(Scene& scene, int root) {
    return camera_in_place(scene, root, with_spin(child_of(root, {0.1, 0.2, 1.0}), {0.0, 0.0, 1.0}, 5.0, 9.0));
}
int zooming(Scene& scene, int root) {
    const int camera = camera_in_place(scene, root, child_of(root, {0.0, 0.0, 1.0}));
    scene.cameras.back().fov = ramp(0.5, 1.5);
    return camera;
}
int orthographic_pan(Scene& scene, int root) {
    const int camera = panning(scene, root);
    scene.cameras.back().orthographic = true;
    scene.cameras.back().half_height = 4.0;
    return camera;
}

/// Everything moves at once, the camera in a hierarchy of its own.
int everything(Scene& scene, int root) {
    deep(scene, root);
    spinning(scene, root);
    scene.cameras.clear();
    for (Node& node : scene.nodes) node.camera = no_index;
    Node crane = with_spin(child_of(root, {0.0, 0.5, 2.0}), {0.0, 1.0, 0.2}, 0.0, 1.5);
    crane.transform.scale = glm::dvec3(2.0);
    Node head = with_spin(child_of(add_node(scene, crane), {0.1, 0.0, 0.2}), {0.2, 0.1, 1.0}, 0.0, -3.0);
    return add_camera(scene, add_node(scene, head));
}

class MotionTruth : public testing::TestWithParam<std::tuple<Moving, double>> {
  protected:
    MotionTruth() {
        const auto& [moving, distance] = GetParam();
        // Exactly representable, along every axis.
        const int root = add_node(scene_, child_of(no_index, glm::dvec3(distance, -distance, distance)));
        camera_ = moving.build(scene_, root);
    }
    Scene scene_;
    int camera_ = no_index;
};

TEST_P(MotionTruth, ErrorBelowMillionthOfAPixel) {
    for (const int frame : {0, 1, 7, 23}) {
        const double now = scene_.film.frame_rate.seconds_of(frame),
                     other = scene_.film.frame_rate.seconds_of(frame + 1);
        const TwoViews views(scene_, now, other, width, height);
        const Image<Hit> hits = make_random_hits(scene_, views.now.pose, width, height);
        const MotionField field = compute_model_motion(scene_, views.now, views.other, hits);
        std::size_t compared = 0;
        Real worst = 0, longest = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const Hit& hit = hits.pixels[i];
            const Instance& instance = views.now.pose.instances[hit.instance];
            const RealVector point = real_surface_point(scene_.meshes[instance.mesh], hit);
            const auto pixel_at = [&](double seconds) {
                return real_project(scene_, camera_, real_to_world(scene_, instance.node, point, seconds), seconds,
                                    width, height);
            };
            const RealPixel from = pixel_at(now), to = pixel_at(other);
            const Real dx = to.x - from.x, dy = to.y - from.y;
            // Close to the camera a pixel is millions of pixels from the next; there the cap applies.
            if (from.depth < 0.1L || to.depth < 0.1L || std::hypot(dx, dy) > std::hypot(width, height)) continue;
            ++compared;
            longest = std::max(longest, std::hypot(dx, dy));
            worst = std::max(
                {worst, std::abs(field.displacement.pixels[i].x - dx), std::abs(field.displacement.pixels[i].y - dy)});
            const bool inside = to.x >= 0 && to.x <= width && to.y >= 0 && to.y <= height;
            EXPECT_EQ(field.validity.pixels[i], inside ? MotionValidity::valid : MotionValidity::leaves_screen);
        }
        EXPECT_LT(worst, 1e-6L) << "frame " << frame;
        EXPECT_GT(compared, hits.size() / 2) << "frame " << frame;
        EXPECT_GT(longest, 0.1L) << "frame " << frame;
    }
}

TEST_P(MotionTruth, TheSameMomentTwiceGivesExactlyZero) {
    const Image<Hit> hits = make_random_hits(scene_, pose(scene_, 0.3), width, height);
    const MotionField field = motion_between(scene_, 0.3, 0.3, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_EQ(field.displacement.pixels[i], glm::dvec2(0.0));
        ASSERT_EQ(field.path_length.pixels[i], 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, MotionTruth,
    testing::Combine(testing::Values(Moving{"Translation", translating}, Moving{"Spin170", spinning},
                                     Moving{"Quaternions", turning_by_quaternions}, Moving{"DeepHierarchy", deep},
                                     Moving{"Pan", panning}, Moving{"Dolly", dollying}, Moving{"Roll", rolling},
                                     Moving{"Zoom", zooming}, Moving{"Orthographic", orthographic_pan},
                                     Moving{"Everything", everything}),
                     testing::Values(0.0, 1e6)),
    [](const auto& test) {
        return std::string(std::get<0>(test.param).name) + (std::get<1>(test.param) > 0.0 ? "Far" : "Near");
    });

/// Other objects move, so that the frame as a whole is not skipped.
TEST(ModelMotion, StaticObjectsBesideMovingOnesAreExactlyStill) {
    Scene scene;
    const int root = add_node(scene, child_of(no_index, {0.3, -0.1, 0.7}));
    Node still = with_spin(child_of(root, {0.3, 0.2, -7.0}), {0.3, 0.5, 1.0}, 33.0, 0.0);
    still.transform.scale = glm::dvec3(1.1, -0.7, 0.3);
    add_object(scene, still);
    translating(scene, root);
    const Image<Hit> hits = make_random_hits(scene, pose(scene, 0.1), width, height);
    const MotionField field = motion_between(scene, 0.1, 0.4, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits.pixels[i].instance == 0) {
            EXPECT_EQ(field.displacement.pixels[i], glm::dvec2(0.0));
        } else {
            EXPECT_GT(field.path_length.pixels[i], 1.0);
        }
    }
}

/// A zoom changes only the projection: neither object nor camera moves, but the picture does.
TEST(ModelMotion, ZoomMovesObjectsAndBackground) {
    Scene scene;
    Node node = child_of(no_index, {});
    node.meshes = {add_point(scene, {1.0f, 0.5f, -10.0f})};
    add_node(scene, node);
    add_camera(scene);
    scene.cameras[0].fov = ramp(0.6, 0.9);
    const MotionField field = motion_between(scene, 0.0, 1.0, one_hit(width, height, width / 2, height / 2));
    const double grown = 0.5 * height / std::tan(0.45) - 0.5 * height / std::tan(0.3);  // focal length in pixels
    EXPECT_NEAR(field.displacement(width / 2, height / 2).x, 0.1 * grown, 1e-9);
    EXPECT_NEAR(field.displacement(width / 2, height / 2).y, -0.05 * grown, 1e-9);
    const double left_edge = (0.5 - 0.5 * width) / (0.5 * height / std::tan(0.3));
    EXPECT_NEAR(field.displacement(0, height / 2).x, left_edge * grown, 1e-9);
}

/// A film offset that changes moves the whole picture, near and far alike; a constant one moves nothing.
TEST(ModelMotion, FilmOffsetSlidesThePicture) {
    for (const bool orthographic : {false, true}) {
        Scene scene;
        add_object(scene, child_of(no_index, {0.3, 0.2, -7.0}));
        add_camera(scene);
        scene.cameras[0].orthographic = orthographic;
        scene.cameras[0].shift_x = ramp(0.1, 0.35);
        scene.cameras[0].shift_y = -0.2;
        Image<Hit> hits = make_random_hits(scene, pose(scene, 0.0), width, height);
        if (!orthographic) hits(3, 5).instance = no_index;
        for (const glm::dvec2& d : motion_between(scene, 0.0, 1.0, hits).displacement.pixels) {
            ASSERT_NEAR(d.x, -0.25 * height, 1e-9);
            ASSERT_NEAR(d.y, 0.0, 1e-9);
        }
        scene.cameras[0].shift_x = 0.35;
        for (const glm::dvec2& d : motion_between(scene, 0.0, 1.0, hits).displacement.pixels)
            ASSERT_EQ(d, glm::dvec2(0.0));
    }
}

}  // namespace
}  // namespace aleph
