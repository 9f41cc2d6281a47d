// Whole frames: coverage, exposure, counts of rays and records, invalid samples, sums of many samples, mirrored and
// flattened scenes.

#include "render/shade/frame.h"
#include "render/cache/aimed_rays.h"
#include "render/frame/sequence.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A ball and a box on a floor, with everything that causes rays: lamp, point light, sky, glossy surfaces.
Scene make_everything(bool mirrored = false) {
    Scene scene;
    scene.film.exposure = 1.0;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.2, 0.25, 0.3));
    const int white = add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(8.0, 7.0, 5.0));
    scene.materials.push_back({.base_color = glm::dvec3(0.8, 0.3, 0.2), .gloss = {.metallic = 0.2, .roughness = 0.3}});
    const int root = add_node(scene, glm::dvec3(0.0), no_turn);
    if (mirrored) scene.nodes[0].transform.scale = glm::dvec3(-1.0, 1.0, 1.0);
    Shape ball{.kind = Shape::Kind::sphere, .radius = 0.6, .segments = 32};
    add_mesh(scene, make_quad(6.0, 6.0, white), glm::dvec3(0.0), z_to_up, root);
    add_mesh(scene, make_shape_mesh(ball, 2), {0.7, 0.6, 0.2}, no_turn, root);
    add_mesh(scene, make_box({0.8, 1.4, 0.8}, white), {-0.8, 0.7, -0.6}, turn_about_y(0.5), root);
    add_mesh(scene, make_quad(1.0, 0.7, lamp), {-0.4, 2.5, 0.5}, z_to_down, root);
    add_light(scene, Light::Kind::point, glm::dvec3(2.0), {1.5, 1.5, 1.0}, no_turn, root);
    add_camera(scene, {0.0, 1.6, 4.0}, {0.0, 0.5, 0.0}, 0.9);
    return scene;
}

TEST(Frame, RaysByPurposeSumToWhatTheWrapperTraced) {
    const Scene scene = make_everything();
    RayCounts light_rays;
    const Stage stage(scene, 40, 30);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::vector<PixelSurface> seen;
    for (int i = 0; i < 40 * 30; ++i) {
        if (centers.hits.pixels[i].instance != no_index)
            seen.push_back(make_pixel_surface(stage.shading, stage.view, centers, i % 40, i / 40));
    }
    const bool aims = !find_bright_surfaces(stage.lighting(), seen, light_rays).empty();
    const int rays_per_record = aims ? 16 + 16 / around_per_aimed : 16;
    for (const int spp : {1, 3}) {
        for (const double accuracy : {0.0, 0.3}) {
            for (const Guide guide : {Guide::none, Guide::saliency}) {
                RenderSettings settings = plain_settings(accuracy, 16);
                settings.picture = {.width = 40, .height = 30, .filter = PixelFilter::box};
                settings.sampling.spp = spp;
                settings.light.light_samples = 4;
                settings.perception.guide = guide;
                const FrameRequest request{.maps = guide == Guide::saliency, .progress = {}};
                const FrameStatistics s = Sequence(scene, settings).render(0, request).statistics;
                EXPECT_EQ(s.counts.rays.total(), s.traced.all + s.traced.invalid);
                EXPECT_EQ(s.traced.invalid, 0u);
                EXPECT_GT(s.counts.rays.shadow, 0u);
                EXPECT_GT(s.counts.rays.glossy, 0u);
                const std::uint64_t gather = s.counts.rays.gather - light_rays.gather;
                EXPECT_GE(gather, 15 * s.counts.records);  // a few are below smooth-shaded facets
                EXPECT_EQ(s.counts.records > 0, accuracy > 0.0);
                if (guide == Guide::none) {
                    EXPECT_LE(gather, rays_per_record * s.counts.records);
                } else {  // and those of the quick estimate
                    EXPECT_GT(gather, rays_per_record * s.counts.records);
                }
                EXPECT_EQ(s.counts.rays.specular, 0u);
                EXPECT_GT(s.counts.rays.path, 0u);  // of what reflections show
                EXPECT_EQ(s.counts.samples, 40u * 30u * static_cast<unsigned>(spp));
                EXPECT_EQ(s.counts.invalid_samples, 0u);
            }
        }
    }
}

TEST(Frame, EmissionCoverageAndBackground) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.5, 0.25, 0.125));
    add_mesh(scene, make_quad(1.0, 20.0, add_lambert(scene, glm::dvec3(0.0), {2.0, 4.0, 8.0})), {0.5, 0.0, -2.0});
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.9);
    IndirectStage room(std::move(scene), 16, 12, 0.15, 16);
    room.settings.light.bounces = 0;
    for (const int spp : {1, 16}) {
        room.settings.sampling.spp = spp;
        const ShadedFrame out = shade_frame(room.context, room.centers, 3.0);
        // The lamp covers columns 8 (its edge lies on the pixels' border) to 8 + half the frame's height in m.
        EXPECT_EQ(out.color(9, 6), Rgb(6.0f, 12.0f, 24.0f));
        EXPECT_EQ(out.coverage(9, 6), 1.0f);
        EXPECT_EQ(out.color(5, 6), Rgb(1.5f, 0.75f, 0.375f));
        EXPECT_EQ(out.coverage(5, 6), 0.0f);
        EXPECT_EQ(out.samples(5, 6), static_cast<float>(spp));
    }
}

TEST(Frame, MC03_SamplesThatAreNotFiniteAreThrownAwayAndCounted) {
    Scene scene;
    add_mesh(scene, make_quad(1.0, 20.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(3e38))), {0.5, 0.0, -2.0});
    scene.materials[0].glow.strength = 10.0;  // more than a float can hold
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.9);
    const Stage stage(std::move(scene), 16, 12);
    const ShadedFrame out = shade(stage, plain_settings(0.15, 16));
    double invalid = 0.0;
    for (std::size_t i = 0; i < out.color.size(); ++i) {
        EXPECT_EQ(out.color.pixels[i], Rgb(0.0f));
        invalid += out.invalid_samples.pixels[i];
    }
    EXPECT_EQ(static_cast<double>(out.counts.invalid_samples), invalid);
    EXPECT_GT(invalid, 10.0);
}

/// Without randomness: point light, no bounces or reflections, flat facets.
Scene make_plain_scene(bool mirrored) {
    Scene scene = make_everything(mirrored);
    scene.environment.radiance.reset();
    scene.materials[1].glow.color = glm::dvec3(0.0);
    return scene;
}

TEST(Frame, KF17_MirroredSceneIsTheMirroredPicture) {
    constexpr int width = 64, height = 48;
    const Stage plain(make_plain_scene(false), width, height), mirrored(make_plain_scene(true), width, height);
    RenderSettings settings = plain_settings(0.15, 16);
    settings.light.bounces = 0;
    settings.light.path_depth = 1;
    const Image<Rgb> one = shade(plain, settings).color, other = shade(mirrored, settings).color;
    const SampleHits hits = cast_centers(mirrored.rays, mirrored.view, nullptr);
    int differing = 0, lit = 0;
    for (const auto [x, y] : all_pixels(width, height)) {
        const float a = one(x, y).x, b = other(width - 1 - x, y).x;
        if (std::abs(a - b) > 1e-4f + 1e-3f * a) ++differing;
        if (a > 0.01f) ++lit;
        if (hits.hits(x, y).instance == no_index) continue;
        const PixelSurface s = make_pixel_surface(mirrored.shading, mirrored.view, hits, x, y);
        EXPECT_GT(glm::dot(s.point.normal, s.view), -0.2f);  // shading normals may lean away at silhouettes
        EXPECT_GT(glm::dot(s.point.geometric, s.view), 0.0f);
        EXPECT_TRUE(s.point.front) << "a mirrored outside is still an outside";
    }
    EXPECT_GT(lit, width * height / 3);
    EXPECT_LE(differing, width * height / 100);  // rays along edges and shadow borders
}

TEST(Frame, KF18_FlattenedObjectsLeaveAPictureWithoutHoles) {
    const auto render = [](const glm::dvec3& scale, bool keep) {
        Scene scene = make_everything();
        scene.nodes[3].transform.scale = scale;  // the box
        if (!keep) scene.nodes[3].visible = 0.0;
        const Stage stage(std::move(scene), 40, 30);
        const ShadedFrame out = shade(stage, plain_settings(0.2, 32));
        EXPECT_EQ(out.counts.invalid_samples, 0u);
        return out.color;
    };
    const Image<Rgb> without = render(glm::dvec3(1.0), false);
    for (const glm::dvec3 scale : {glm::dvec3(1.0, 0.0, 1.0), glm::dvec3(0.0)}) EXPECT_EQ(render(scale, true), without);
}

}  // namespace
}  // namespace aleph
