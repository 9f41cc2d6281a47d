// Reprojection with real rays: single-precision hits must not disturb motion.

#include "motion/reprojection.h"
#include "tests/support/motion_truth.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ReprojectionRays, RP01_StaticSceneMovesByExactlyZero) {
    for (const double tilt : {45.0, 10.0, 1.0, 0.1}) {
        Scene scene;
        Node plane{.transform = {.translation = glm::dvec3(0.0, -1.0, -3.0),
                                 .axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, (tilt - 90.0) * degrees}},
                   .meshes = {add_grid(scene, 1000.0f, 1000.0f, 8)}};
        add_node(scene, plane);
        Node mount{.transform = {.translation = glm::dvec3(0.1, 0.7, -0.3),
                                 .axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.03}}};
        add_camera(scene, add_node(scene, mount));
        const auto [now, other, hits, field] = SeenMotion(scene, 0.0, 1.0 / 30.0, 320, 240);
        std::size_t surface = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            ASSERT_EQ(field.displacement.pixels[i], glm::dvec2(0.0)) << tilt;
            ASSERT_EQ(field.path_length.pixels[i], 0.0) << tilt;
            if (hits.pixels[i].instance == no_index) continue;
            ++surface;
            ASSERT_EQ(field.validity.pixels[i], MotionValidity::valid) << tilt;
        }
        EXPECT_GT(surface, hits.size() / 10) << tilt;
    }
}

TEST(ReprojectionRays, RP18_BarycentricsOffTheTriangleArePutBack) {
    Scene scene;
    add_point(scene, {1.0f, 2.0f, 3.0f});  // corners p, p + x, p + y
    const struct {
        float u, v;
        glm::dvec2 expected;
    } cases[] = {{0.25f, 0.5f, {0.25, 0.5}},
                 {1.0f, 0.0f, {1.0, 0.0}},
                 {0.0f, 1.0f, {0.0, 1.0}},
                 {1.0000001f, 0.0f, {1, 0}},
                 {-1e-7f, 0.5f, {0.0, 0.5}},
                 {0.5f, -1e-7f, {0.5, 0.0}},
                 {0.75f, 0.75f, {0.5, 0.5}},
                 {0.50000006f, 0.5f, {0.5, 0.5}},
                 {float_nan, 0.5f, {0.0, 0.5}},
                 {0.5f, float_nan, {0.5, 0.0}},
                 {float_infinity, 0.0f, {1.0, 0.0}},
                 {-float_infinity, -float_infinity, {0.0, 0.0}},
                 {float_infinity, float_infinity, {0.5, 0.5}},
                 {-0.0f, 1e-45f, {0.0, 0.0}}};
    for (const auto& c : cases) {
        const glm::dvec3 point = surface_point(scene.meshes[0], {.instance = 0, .primitive = 0, .u = c.u, .v = c.v});
        EXPECT_NEAR(point.x, 1.0 + c.expected.x, 1e-7) << c.u << ' ' << c.v;
        EXPECT_NEAR(point.y, 2.0 + c.expected.y, 1e-7) << c.u << ' ' << c.v;
        EXPECT_EQ(point.z, 3.0);
        EXPECT_LE((point.x - 1.0) + (point.y - 2.0), 1.0 + 1e-15);
        EXPECT_GE(std::min(point.x - 1.0, point.y - 2.0), 0.0);
    }
}

TEST(ReprojectionRays, RP18_HitsOnSubPixelTrianglesLieAtTheirPixel) {
    // Triangles 1e-3 px across, upright and grazing, around the centre of pixel (70, 40).
    for (const double tilt : {0.0, 80.0, 89.0}) {
        Scene scene;
        const double metres_per_pixel = 5.0 / 1000.0;
        Node node;
        node.meshes = {add_grid(scene, static_cast<float>(0.04 * metres_per_pixel),
                                static_cast<float>(0.04 * metres_per_pixel / std::cos(tilt * degrees)), 40)};
        node.transform.translation =
            glm::dvec3((70.5 - 50.0) * metres_per_pixel, (50.0 - 40.5) * metres_per_pixel, -5.0);
        node.transform.axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, -tilt * degrees};
        add_node(scene, node);
        add_camera(scene, no_index, fov_of(1000.0, 100));
        const PosedView posed = make_posed_view(scene, 0.0, 0, 100, 100);
        const Image<Hit> hits = cast_first_hits(scene, posed);
        ASSERT_EQ(hits(70, 40).instance, 0) << tilt;
        const CameraFromObject map = make_camera_from_object(posed.view, posed.pose.world[0]);
        const glm::dvec2 pixel = project_camera_point(posed.view, map(surface_point(scene.meshes[0], hits(70, 40))));
        EXPECT_NEAR(pixel.x, 70.5, 1e-4) << tilt;
        EXPECT_NEAR(pixel.y, 40.5, 1e-4) << tilt;
    }
}

TEST(ReprojectionRays, RP19_BarycentricPointsLieOnTheirTriangles) {
    // Long slivers at 500 m whose planes are almost parallel to the ray: the distance along it is inaccurate.
    Scene scene;
    Mesh slivers;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (unsigned i = 0; i < 30000; ++i) {
        const glm::vec3 start(40.0f * uniform(random), 30.0f * uniform(random), -500.0f + 50.0f * uniform(random));
        // Towards the camera, nearly.
        const glm::vec3 length = -0.2f * start + 0.02f * glm::vec3(uniform(random), uniform(random), 0.0f);
        const glm::vec3 breadth = -0.1f * start + glm::vec3(uniform(random), uniform(random), 0.0f);
        slivers.positions.push_back(start);
        slivers.positions.push_back(start + length);
        slivers.positions.push_back(start + breadth);
        slivers.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    scene.meshes = {slivers};
    Node node{.meshes = {0}};
    add_node(scene, node);
    add_camera(scene, no_index, 0.12);
    const PosedView posed = make_posed_view(scene, 0.0, 0, 320, 240);
    const Image<Hit> hits = cast_first_hits(scene, posed);
    Real worst = 0, worst_by_distance = 0;
    std::size_t count = 0;
    for (int y = 0; y < hits.height; ++y) {
        for (int x = 0; x < hits.width; ++x) {
            const Hit& hit = hits(x, y);
            if (hit.instance == no_index) continue;
            ++count;
            const glm::uvec3& triangle = slivers.triangles[hit.primitive];
            const RealVector p0(slivers.positions[triangle.x]), p1(slivers.positions[triangle.y]),
                p2(slivers.positions[triangle.z]);
            const RealVector normal = unit(glm::cross(p1 - p0, p2 - p0));
            const RealVector point(surface_point(slivers, hit));
            worst = std::max(worst,
                             std::abs(glm::dot(point - p0, normal)) / (glm::distance(p0, p1) + glm::distance(p0, p2)));
            const CameraRay ray = make_camera_ray(posed.view, x + 0.5, y + 0.5);
            const glm::dvec3 along = ray.origin + static_cast<double>(hit.distance) * ray.direction;
            worst_by_distance = std::max(worst_by_distance, glm::distance(RealVector(along), point));
        }
    }
    EXPECT_GT(count, 1000u);
    EXPECT_LT(worst, 1e-6L);
    // Where Embree's own distance is off by a good part of a metre: 500 m along slivers that are seen edge-on.
    EXPECT_LT(worst_by_distance, 1e-4L);
}

}  // namespace
}  // namespace aleph
