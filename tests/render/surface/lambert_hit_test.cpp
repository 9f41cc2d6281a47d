// The short way to a Lambert surface that a gather ray meets finds what the full one does.

#include "render/surface/lambert_hit.h"
#include "render/surface/surface_material.h"
#include "tests/support/keyed_track.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A board of two colours at its corners, partly beyond what a surface can reflect, and a turned box of one colour,
/// seen from both of their sides.
Scene make_colored_scene() {
    Scene scene;
    const int white = add_lambert(scene, {0.9, 0.8, 0.5}, glm::dvec3(0.0), true);
    Mesh board = make_quad(2.0, 2.0, white);
    for (std::size_t i = 0; i < board.positions.size(); ++i) {
        board.colors.push_back(i % 2 == 0 ? glm::vec4(3.0f, 0.2f, -0.1f, 1.0f) : glm::vec4(0.1f, 0.4f, 1.0f, 1.0f));
    }
    add_mesh(scene, board, {0.0, 0.0, -1.0});
    add_mesh(scene, make_box({0.5, 0.4, 0.3}, white), {0.2, 0.1, 0.0}, glm::angleAxis(0.7, glm::dvec3(0.6, 0.8, 0.0)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 1.0, 2.0});
    add_camera(scene, {0.0, 0.0, 2.0}, glm::dvec3(0.0), 0.9);
    return scene;
}

/// Both kinds of objects, those of the flat tree and those that move, by single rays and in packets.
TEST(LambertHit, IsTheSurfaceOfTheFullWay) {
    Scene scene = make_colored_scene();
    add_mesh(scene, make_box({0.3, 0.3, 0.3}, 0), {-0.6, -0.4, 0.2});
    scene.nodes.back().transform.axis_rotation = AxisRotation{{0.0, 0.6, 0.8}, keyed<double>({0.0, 1.0}, {0.1, 0.9})};
    const Stage stage(std::move(scene), 40, 30);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::vector<Ray> rays;
    for (const auto [x, y] : all_pixels(40, 30)) {
        const CameraRay ray = make_sample_ray(stage.view, centers.place, x, y);
        rays.push_back({glm::vec3(ray.origin - stage.rays.anchor()), glm::vec3(ray.direction)});
    }
    Tracer tracer(stage.rays);
    std::vector<Hit> hits(rays.size());
    std::vector<glm::vec3> normals(rays.size());
    tracer.intersect(rays, hits, normals);
    int met[2] = {};
    bool varied = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        glm::vec3 normal(0.0f);
        const Hit hit = tracer.intersect(rays[i], &normal);
        ASSERT_EQ(hit.instance, hits[i].instance);
        if (hit.instance == no_index) continue;
        ASSERT_TRUE(stage.shading.materials[stage.shading.instances[hit.instance].material].plain_lambert);
        const bool is_flat = stage.rays.is_flat(hit.instance);
        ++met[is_flat ? 1 : 0];
        EXPECT_LT(glm::length(normals[i] - normal), 1e-6f * glm::length(normal));
        const SurfacePoint point = make_surface_point(stage.shading, hit, rays[i].direction);
        const SurfacePlace place = make_surface_place(stage.shading, hit, rays[i].direction);
        const LambertHit single = make_lambert_hit(stage.shading, rays[i], hit, normal, 1e-3f);
        const LambertHit packed = make_lambert_hit(stage.shading, rays[i], hits[i], normals[i], 1e-3f);
        EXPECT_LT(glm::length(single.position - place.position), 1e-6f);
        EXPECT_LT(glm::length(single.geometric - point.geometric), is_flat ? 1e-6f : 2e-6f);
        EXPECT_LT(glm::length(packed.geometric - point.geometric), 2e-6f);
        EXPECT_LT(glm::length(single.albedo - evaluate_material(stage.shading, point, {}).diffuse), 1e-6f);
        EXPECT_LE(largest_channel(single.albedo), 1.0f);
        varied = varied || single.albedo.x < 0.5f;
    }
    EXPECT_GT(met[0], 20);
    EXPECT_GT(met[1], 200);
    EXPECT_TRUE(varied);
}

}  // namespace
}  // namespace aleph
