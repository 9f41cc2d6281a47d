// Footprints of rays against finite differences between the hits of neighbouring rays, and against closed forms.
// A checker texture at a grazing angle, filtered by the footprints of pixels, against many samples per pixel.

#include "render/pixels/pixel_surfaces.h"
#include "render/surface/texture.h"
#include "tests/support/first_hits.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Case {
    const char* name;
    std::function<Scene()> make;
    double step;       ///< pixels between the rays that are compared
    double tolerance;  ///< relative to the footprint's length
    int least;         ///< least number of pixels to compare
};
void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

Scene make_plane(const glm::dvec3& at = glm::dvec3(0.0)) {
    Scene scene;
    Mesh mesh = make_quad(6.0, 4.0, add_lambert(scene, glm::dvec3(0.5)));
    mesh.uv[1] = mesh.uv[0];
    for (glm::vec2& uv : mesh.uv[1]) uv = {7.0f * uv.y + 0.5f * uv.x, 3.0f * uv.x};
    const int node = add_mesh(scene, mesh, at, glm::angleAxis(0.4, glm::normalize(glm::dvec3(1.0, 2.0, 0.5))));
    scene.nodes[node].transform.scale = glm::dvec3(1.5, 0.7, 1.0);
    add_camera(scene, at + glm::dvec3(0.7, 0.4, 5.0), at);
    return scene;
}

Scene make_orthographic() {
    Scene scene = make_plane();
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 1.7;
    scene.cameras[0].shift_x = 0.3;
    return scene;
}

Scene make_shifted() {
    Scene scene = make_plane();
    scene.cameras[0].shift_x = -0.4;
    scene.cameras[0].shift_y = 0.3;
    return scene;
}

Scene make_ball() {
    Scene scene;
    Shape ball{.kind = Shape::Kind::sphere, .radius = 1.0};
    ball.segments = 12;  // large facets, so that neighbouring rays often meet the same
    const int node = add_mesh(scene, make_shape_mesh(ball, add_lambert(scene, glm::dvec3(0.5))));
    scene.nodes[node].transform.scale = glm::dvec3(-1.0, 1.3, 1.0);  // mirrored
    add_camera(scene, {0.3, 1.0, 3.0}, glm::dvec3(0.0));
    return scene;
}

Scene make_grazing() {
    Scene scene;
    Mesh floor = make_quad(40.0, 40.0, add_lambert(scene, glm::dvec3(0.5)));
    add_mesh(scene, floor, glm::dvec3(0.0), z_to_up);
    add_camera(scene, {0.0, 0.2, 10.0}, {0.0, 0.0, 0.0});
    return scene;
}

Scene make_mirrored_far() {
    return make_plane({1e6, -1e6, 1e6});
}

class FootprintOf : public testing::TestWithParam<Case> {};

TEST_P(FootprintOf, IsTheDerivativeOfTheCoordinates) {
    const Case& test = GetParam();
    const Stage stage(test.make(), 64, 48);
    Tracer tracer(stage.rays);
    const auto cast = [&](double x, double y, glm::vec3& direction) {
        const CameraRay ray = make_camera_ray(stage.view, x, y);
        direction = glm::vec3(ray.direction);
        return tracer.intersect({glm::vec3(ray.origin - stage.rays.anchor()), direction});
    };
    int compared = 0;
    for (int y = 2; y < 46; y += 3) {
        for (int x = 2; x < 62; x += 3) {
            glm::vec3 direction, other;
            const Hit hit = cast(x + 0.5, y + 0.5, direction);
            if (hit.instance == no_index) continue;
            const SurfacePoint point = make_surface_point(stage.shading, hit, direction);
            constexpr float spacing = 0.25f;
            const RayFootprint footprint = make_pixel_footprint(stage.view, point, direction, hit.distance, spacing);
            for (int set = 0; set < 2; ++set) {
                const UvFootprint found = make_uv_footprint(point, footprint, set);
                EXPECT_FALSE(found.round);
                for (const bool along_y : {false, true}) {
                    glm::dvec2 ends[2];
                    bool same = true;
                    for (int side = 0; side < 2; ++side) {
                        const double d = (side == 0 ? -1.0 : 1.0) * test.step;
                        const Hit near = cast(x + 0.5 + (along_y ? 0.0 : d), y + 0.5 + (along_y ? d : 0.0), other);
                        same = same && near.instance == hit.instance && near.primitive == hit.primitive;
                        if (same) ends[side] = glm::dvec2(make_surface_point(stage.shading, near, other).uv[set]);
                    }
                    if (!same) continue;
                    const glm::dvec2 expected = (ends[1] - ends[0]) / (2.0 * test.step) * static_cast<double>(spacing);
                    const glm::dvec2 derivative(along_y ? found.dy : found.dx);
                    ASSERT_LE(glm::length(derivative - expected),
                              test.tolerance * glm::length(expected) + 0.25e-7 / test.step)
                        << "pixel " << x << ", " << y << " set " << set << (along_y ? " y" : " x") << ": "
                        << derivative.x << " " << derivative.y << " for " << expected.x << " " << expected.y;
                    ++compared;
                }
            }
        }
    }
    EXPECT_GE(compared, test.least);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, FootprintOf,
                         testing::Values(Case{"Plane", [] { return make_plane(); }, 0.25, 2e-3, 300},
                                         Case{"Orthographic", make_orthographic, 0.25, 1e-3, 300},
                                         Case{"FilmOffset", make_shifted, 0.25, 2e-3, 300},
                                         Case{"Sphere", make_ball, 0.25, 1e-2, 100},
                                         Case{"Grazing", make_grazing, 0.02, 1e-2, 300},
                                         Case{"FarFromTheOrigin", make_mirrored_far, 0.25, 2e-2, 300}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Footprint, FacingPlaneIsAPixelAcross) {
    Scene scene;
    add_mesh(scene, make_quad(8.0, 8.0, add_lambert(scene, glm::dvec3(0.5))));
    add_camera(scene, {0.0, 0.0, 5.0}, glm::dvec3(0.0));
    const Stage stage(std::move(scene), 64, 48);
    for (int i = 0; i < 2; ++i) {
        RenderSettings settings;
        settings.sampling.spp = i == 0 ? 1 : 9;
        const SamplePlace place = make_sample_place(settings, {}, false, 0, i);
        const SampleHits sample = cast_sample(stage.rays, stage.view, place, nullptr);
        const glm::vec3 direction(make_sample_ray(stage.view, place, 20, 10).direction);
        const SurfacePoint point = make_surface_point(stage.shading, sample.hits(20, 10), direction);
        const RayFootprint found =
            make_pixel_footprint(stage.view, point, direction, sample.hits(20, 10).distance, place.spacing);
        // Nine samples per pixel are a third of a pixel apart.
        const float pixel = 5.0f / static_cast<float>(stage.view.pixels_per_unit) / (i == 0 ? 1.0f : 3.0f);
        EXPECT_NEAR(found.dx.x, pixel, 1e-5f * pixel);
        EXPECT_NEAR(found.dy.y, -pixel, 1e-5f * pixel);
        EXPECT_NEAR(glm::length(found.dx - glm::vec3(pixel, 0.0f, 0.0f)), 0.0f, 1e-5f * pixel);
    }
}

TEST(Footprint, ConesGrowWithDistanceAndSlant) {
    SurfacePoint point = make_point(glm::vec3(0.0f), up);
    point.edges[0] = {0.0f, 0.0f, 2.0f};
    point.edges[1] = {2.0f, 0.0f, 0.0f};
    point.uv_edges[0][0] = {0.0f, 1.0f};
    point.uv_edges[0][1] = {4.0f, 0.0f};
    const glm::vec3 down(0.0f, -1.0f, 0.0f), slanted(0.8f, -0.6f, 0.0f);
    for (const float distance : {1.0f, 3.0f}) {
        // 0.01 sr at d metres covers 0.01 d^2 m2; a square metre of this surface is 1 in u times v.
        const UvFootprint straight = make_uv_footprint(point, make_cone_footprint(point, down, distance, 0.01f), 0);
        EXPECT_TRUE(straight.round);
        EXPECT_NEAR(straight.dx.x * straight.dy.y, 0.01f * distance * distance, 1e-6f);
        const UvFootprint oblique = make_uv_footprint(point, make_cone_footprint(point, slanted, distance, 0.01f), 0);
        EXPECT_NEAR(oblique.dx.x * oblique.dy.y, 0.01f * distance * distance / 0.6f, 1e-6f);
    }
    // Footprints of grazing cones are limited.
    const RayFootprint edge_on = make_cone_footprint(point, {1.0f, 0.0f, 0.0f}, 1.0f, 0.01f);
    EXPECT_TRUE(std::isfinite(edge_on.width));
}

TEST(Footprint, WithoutCoordinatesThereIsNone) {
    SurfacePoint point = make_point(glm::vec3(0.0f), up);
    point.edges[0] = {0.0f, 0.0f, 2.0f};
    point.edges[1] = {2.0f, 0.0f, 0.0f};
    const RayFootprint pixel{{0.1f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.1f}, 0.0f};
    for (const RayFootprint& footprint : {pixel, RayFootprint{{}, {}, 3.0f}}) {
        const UvFootprint found = make_uv_footprint(point, footprint, 1);
        EXPECT_EQ(found.dx, glm::vec2(0.0f));
        EXPECT_EQ(found.dy, glm::vec2(0.0f));
    }
    // A zero footprint stays zero, even if the triangle has no extent.
    const UvFootprint none = make_uv_footprint(make_point(glm::vec3(0.0f), up), {}, 0);
    EXPECT_EQ(none.dx, glm::vec2(0.0f));
}

/// A floor with a checker texture, seen from a low camera. Only its albedo is rendered (no light, `flat` estimate).
struct Checker {
    static Scene make() {
        Scene scene;
        const int material = add_lambert(scene, glm::dvec3(1.0));
        SceneImage image{.bytes = Image<glm::u8vec4>(64, 64)};
        for (const auto [x, y] : all_pixels(64, 64)) {
            image.bytes(x, y) = ((x / 8 + y / 8) % 2 == 0) ? glm::u8vec4(255) : glm::u8vec4(40, 10, 90, 255);
        }
        scene.images.push_back(image);
        scene.materials[0].textures[TextureSlot::base_color] = {.image = 0};
        Mesh floor = make_quad(400.0, 400.0, material);
        for (glm::vec2& uv : floor.uv[0]) uv *= 800.0f;
        add_mesh(scene, floor, glm::dvec3(0.0), z_to_up);
        add_camera(scene, {0.3, 0.6, 3.0}, {0.0, 0.2, 0.0}, 0.6);
        return scene;
    }

    Checker() : stage(make(), 48, 36) {}

    /// Mean of n by n samples in every pixel, each averaged over `footprints` of its own spacing.
    Image<Rgb> render(int n, bool footprints) const {
        Image<Rgb> sum(stage.view.width, stage.view.height);
        for (int i = 0; i < n * n; ++i) {
            const double offset_x = (i % n + 0.5) / n, offset_y = (i / n + 0.5) / n;
            SamplePlace place;
            place.spacing = footprints ? 1.0f / static_cast<float>(n) : 0.0f;
            const Image<Hit> hits = cast_first_hits(stage.rays, stage.view, offset_x, offset_y);
            for (const auto [x, y] : all_pixels(sum)) {
                if (hits(x, y).instance == no_index) continue;
                const glm::vec3 direction(make_camera_ray(stage.view, x + offset_x, y + offset_y).direction);
                sum(x, y) += make_pixel_surface(stage.shading, stage.view, place, hits(x, y), direction, {x, y})
                                 .material.diffuse /
                             static_cast<float>(n * n);
            }
        }
        return sum;
    }

    /// Over the pixels of the floor, from two rows below the horizon down.
    double rms(const Image<Rgb>& a, const Image<Rgb>& b) const {
        double sum = 0.0;
        int count = 0;
        for (const auto [x, y] : all_pixels(a)) {
            const int above = std::max(0, y - 2);
            if (!(reached(x, above) && reached(x, y))) continue;
            const float d = a(x, y).x - b(x, y).x;
            sum += d * d;
            ++count;
        }
        EXPECT_GT(count, 500);
        return std::sqrt(sum / count);
    }
    bool reached(int x, int y) const {
        const CameraRay ray = make_camera_ray(stage.view, x, y);
        return ray.direction.y < 0.0;
    }

    Stage stage;
};

TEST(TextureFilter, GrazingCheckerConvergesAtOnce) {
    const Checker checker;
    const Image<Rgb> truth = checker.render(32, false);  // 1024 per pixel
    const double filtered = checker.rms(checker.render(1, true), truth);
    const double pointwise = checker.rms(checker.render(1, false), truth);
    EXPECT_LT(filtered, 0.04);
    EXPECT_GT(pointwise, 10.0 * filtered);
    // More samples and smaller footprints come closer.
    EXPECT_LT(checker.rms(checker.render(4, true), truth), 0.6 * filtered);
    RecordProperty("filtered", std::to_string(filtered));
    RecordProperty("pointwise", std::to_string(pointwise));
}

}  // namespace
}  // namespace aleph
