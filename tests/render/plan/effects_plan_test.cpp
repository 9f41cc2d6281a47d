// The effects plan: scenes that could mislead it.

#include "render/plan/effects_plan.h"
#include "engine/surface/limit_surface.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/scenes/planned_scenes.h"
#include "tests/support/scenes/subdivision_cages.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Names = std::set<std::string>;

Names effects_of(const Scene& scene, const RenderSettings& settings = planned_settings(), std::int64_t frame = 0) {
    return simulated(Sequence(scene, settings).plan(frame));
}

TEST(EffectsPlan, FX01_FX09_MotionIsComputedWhereSomethingMoves) {
    RenderSettings settings = planned_settings();
    settings.perception.guide = Guide::saliency;
    const FrameRequest maps{.maps = true, .progress = {}};
    Scene scene = make_lit_square();
    scene.nodes[1].transform.translation = Track<glm::dvec3>({0.0, 0.1}, {glm::dvec3(0.1), glm::dvec3(0.1)});
    EXPECT_EQ(effects_of(scene, settings), Names{"direct_light"}) << "keys that are all equal";
    // The maps are those of the stages that were skipped.
    RenderSettings forced = settings;
    forced.effects.force = all_effects();
    const FrameOutput skipped = Sequence(scene, settings).render(0), computed = Sequence(scene, forced).render(0);
    EXPECT_EQ(skipped.limits.threshold.pixels, computed.limits.threshold.pixels);
    EXPECT_EQ(skipped.shaded.color.pixels, computed.shaded.color.pixels);
    const FrameOutput still = Sequence(scene, settings).render(0, maps),
                      field = Sequence(scene, forced).render(0, maps);
    EXPECT_EQ(still.motion.displacement.pixels, field.motion.displacement.pixels);
    EXPECT_EQ(still.motion.validity.pixels, field.motion.validity.pixels);
    EXPECT_EQ(still.perception.saliency.pixels, field.perception.saliency.pixels) << "it is asked for";

    scene.nodes[1].transform.translation = Track<glm::dvec3>({0.0, 0.1}, {glm::dvec3(0.1), glm::dvec3(0.1001)});
    EXPECT_EQ(effects_of(scene, settings), (Names{"direct_light", "motion", "saliency"}));
    EXPECT_EQ(effects_of(scene, settings, 3), Names{"direct_light"}) << "the animation is over";
    settings.perception.guide = Guide::full;
    EXPECT_EQ(effects_of(scene, settings), (Names{"direct_light", "motion"}));
}

TEST(EffectsPlan, FX02_IndirectLightNeedsSurfacesThatSeeEachOther) {
    const Names with{"direct_light", "indirect_diffuse"}, without{"direct_light"};
    Scene scene = make_empty_view();
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {2.0, 2.0, 2.0});
    const int ball = add_mesh(scene, make_faceted_sphere(0.5, 16, white));
    EXPECT_EQ(effects_of(scene), without) << "one convex body";
    scene.nodes[ball].transform.scale = glm::dvec3(20.0);
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, 9.0);
    EXPECT_TRUE(effects_of(scene).contains("indirect_diffuse")) << "the camera is inside";
    scene.nodes[ball].transform.scale = glm::dvec3(1.0);
    const int floor = add_mesh(scene, make_quad(4.0, 4.0, white), {0.0, -0.5, 0.0}, z_to_up);
    EXPECT_TRUE(effects_of(scene).contains("indirect_diffuse"));
    scene.nodes[floor].visible = 0.0;
    EXPECT_FALSE(effects_of(scene).contains("indirect_diffuse"));
    scene.nodes[floor].visible = 1.0;
    scene.materials[white].base_color = glm::dvec3(0.0);
    EXPECT_FALSE(effects_of(scene).contains("indirect_diffuse")) << "albedo 0";
}

TEST(EffectsPlan, FX02_LightThatIsOutAtTheMiddleOfTheShutter) {
    // A lamp shines down on the floor, whose light the wall alone gets.
    Scene scene = make_empty_view();
    scene.cameras.back().shutter = glm::dvec2(0.0, 1.0);
    const int grey = add_lambert(scene, glm::dvec3(0.6));
    add_mesh(scene, make_quad(4.0, 4.0, grey));
    add_mesh(scene, make_quad(4.0, 4.0, grey), {0.0, -1.5, 2.0}, z_to_up);
    const int lamp = add_light(scene, Light::Kind::spot, glm::dvec3(40.0), {0.0, 1.3, 2.0}, z_to_up);
    RenderSettings settings = planned_settings();
    settings.sampling.spp = 64;
    const auto mean = [&] { return mean_of_pixels(Sequence(scene, settings).render(0).shaded).mean(); };
    const double always = mean();
    ASSERT_GT(always, 1e-3);
    scene.nodes[lamp].visible =
        Track<double>({0.0, 0.3 / scene.film.frame_rate.per_second()}, {1.0, 0.0}, Interpolation::step);
    EXPECT_TRUE(effects_of(scene, settings).contains("indirect_diffuse"));
    EXPECT_NEAR(mean(), 0.3 * always, 0.03 * always);
}

TEST(EffectsPlan, FX15_AnUnevenWayOfTheCameraIsLookedAtBetweenItsKeys) {
    Scene scene = make_lit_square();
    scene.cameras.back().shutter = glm::dvec2(0.0, 1.0);
    std::vector<double> times;
    std::vector<glm::dvec3> places;
    for (int i = 0; i <= 16; ++i) {
        times.push_back(i / 16.0 / scene.film.frame_rate.per_second());
        places.emplace_back(0.3 * (i % 2), 0.0, 3.0);
    }
    scene.nodes[0].transform.translation = Track<glm::dvec3>(times, places);
    EXPECT_TRUE(effects_of(scene).contains("motion_blur"));
}

TEST(EffectsPlan, FX02_OrthographicRaysMayStartInsideABodyBesideTheCamera) {
    Scene scene = make_empty_view();
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 3.0;
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    const int ball = add_mesh(scene, make_faceted_sphere(1.0, 16, white), {2.0, 0.0, 3.0});
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {2.0, 0.0, 3.0});
    EXPECT_TRUE(effects_of(scene).contains("indirect_diffuse")) << "the camera's plane cuts the ball";
    scene.nodes[ball].transform.translation = glm::dvec3(2.0, 0.0, 0.0);
    EXPECT_FALSE(effects_of(scene).contains("indirect_diffuse")) << "the ball is before the plane";
    scene.nodes[ball].transform.translation = glm::dvec3(12.0, 0.0, 3.0);
    EXPECT_FALSE(effects_of(scene).contains("indirect_diffuse")) << "beside the picture";
}

TEST(EffectsPlan, FX03_FX06_GlossAndMirrorsThatAreSeen) {
    Scene scene = make_lit_square();
    const int glossy = add_material(scene, 0.0, 0.4);
    EXPECT_FALSE(effects_of(scene).contains("glossy_reflection")) << "a material that nothing uses";
    add_mesh(scene, make_quad(0.5, 0.5, glossy), {0.0, 0.0, 8.0});
    EXPECT_FALSE(effects_of(scene).contains("glossy_reflection")) << "behind the camera";
    scene.meshes[0].material = add_material(scene, 1.0, 1e-6);
    const Names seen = effects_of(scene);
    EXPECT_TRUE(seen.contains("mirror_reflection")) << "a roughness of 1e-6";
    EXPECT_TRUE(seen.contains("glossy_reflection")) << "gloss behind the camera, in a mirror";
}

TEST(EffectsPlan, FX02_SquaresInOnePlaneSendEachOtherNothing) {
    Scene scene = make_empty_view();
    const int white = add_lambert(scene, glm::dvec3(0.8));
    add_mesh(scene, make_quad(1.0, 1.0, white), {-0.6, 0.0, 1.0});
    const int other = add_mesh(scene, make_quad(1.0, 1.0, white), {0.6, 0.0, 1.0});
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.0, 0.0, 2.0});
    EXPECT_FALSE(effects_of(scene).contains("indirect_diffuse"));
    scene.nodes[other].transform.translation = glm::dvec3(0.6, 0.0, 1.1);
    EXPECT_TRUE(effects_of(scene).contains("indirect_diffuse"));
}

TEST(EffectsPlan, FX03_FX06_TexturesThatGlossIsTimes) {
    Scene scene = make_lit_square();
    const int metal = scene.meshes[0].material = add_material(scene, 1.0, 0.5);
    scene.materials[metal].gloss.specular = 0.0;
    const auto with = [&](const glm::u8vec4& texel) {
        scene.materials[metal].textures[TextureSlot::metallic_roughness] = add_texture(scene, texel);
        return effects_of(scene);
    };
    EXPECT_EQ(with({255, 255, 255, 255}), (Names{"direct_light", "glossy_reflection", "textures"}));
    EXPECT_EQ(with({255, 0, 255, 255}), (Names{"direct_light", "mirror_reflection", "textures"})) << "smooth";
    EXPECT_EQ(with({255, 255, 0, 255}), (Names{"direct_light", "textures"})) << "no metal";
}

TEST(EffectsPlan, FX04_LampsThatShine) {
    Scene scene = make_lit_square();
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0));
    add_mesh(scene, make_quad(0.5, 0.5, lamp), {0.0, 0.0, 4.0}, z_to_up * z_to_up);
    EXPECT_EQ(effects_of(scene), Names{"direct_light"}) << "an emission of 0";
    scene.materials[lamp].glow.color = glm::dvec3(1.0);
    EXPECT_TRUE(effects_of(scene).contains("emission"));
    scene.materials[lamp].textures[TextureSlot::emission] = add_texture(scene, {0, 0, 0, 255});
    EXPECT_FALSE(effects_of(scene).contains("emission")) << "a black texture";
    scene.images.back().bytes(1, 1) = {255, 0, 0, 255};
    EXPECT_TRUE(effects_of(scene).contains("emission"));
}

TEST(EffectsPlan, FX05_ShadowsNeedSomethingBetween) {
    Scene scene = make_lit_square();
    Sequence open(scene, planned_settings());
    EXPECT_EQ(open.render(0).statistics.counts.rays.shadow, 0u);
    const int ball = add_mesh(scene, make_faceted_sphere(0.2, 8, add_lambert(scene, glm::dvec3(0.0))), {0.3, 0.2, 2.0});
    const FrameOutput inside = Sequence(scene, planned_settings()).render(0);
    EXPECT_GT(inside.statistics.counts.rays.shadow, 0u) << "the lamp is inside a ball";
    EXPECT_EQ(inside.shaded.color(12, 8), Rgb(0.0f));
    scene.nodes[ball].transform.translation = glm::dvec3(0.0, 0.0, -5.0);
    EXPECT_EQ(Sequence(scene, planned_settings()).render(0).statistics.counts.rays.shadow, 0u) << "behind the square";
}

TEST(EffectsPlan, FX07_FX08_ShapesThatChange) {
    Scene scene = make_lit_square();
    TestCage test = make_cube_cage();
    EXPECT_FALSE(effects_of(scene).contains("subdivision"));
    PointCache points;
    points.positions = {{test.points.begin(), test.points.end()}};
    scene.point_caches.push_back(points);
    test.cage.points = 0;
    scene.cages.push_back(test.cage);
    Mesh surface;
    surface.subdivision.cage = 0;
    surface.material = 0;
    scene.meshes.push_back(surface);
    tessellate_cage(scene, 0);
    scene.nodes[1].meshes = {1};
    EXPECT_TRUE(effects_of(scene).contains("subdivision"));
    RenderSettings flat = planned_settings();
    flat.picture.subdivision_level = 0;
    EXPECT_FALSE(effects_of(scene, flat).contains("subdivision"));

    Scene skinned = make_skin_scene();
    add_camera(skinned, {4.0, -3.0, 9.0}, {5.0, -3.0, 2.0});
    skinned.film.exposure = 1.0;
    EXPECT_FALSE(effects_of(skinned).contains("deformation")) << "joints at rest";
    skinned.nodes[2].transform.rotation =
        Track<glm::dquat>({0.0, 1.0}, {glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dquat(0.6, 0.0, 0.0, 0.8)});
    EXPECT_TRUE(effects_of(skinned).contains("deformation"));
    Mesh& mesh = scene.meshes[0];
    scene.nodes[1].meshes = {0};
    mesh.deformation.targets.resize(1);
    mesh.deformation.targets[0].positions.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 0.1f));
    mesh.deformation.target_weights = {Track<double>(0.0)};
    EXPECT_FALSE(effects_of(scene).contains("deformation")) << "weights of 0";
    mesh.deformation.target_weights = {Track<double>({0.0, 1.0}, {0.0, 1.0})};
    EXPECT_TRUE(effects_of(scene).contains("deformation"));
}

TEST(EffectsPlan, FX11_ABlackEnvironmentIsNone) {
    Scene scene = make_lit_square();
    make_surroundings(scene, 0.0);
    EXPECT_EQ(effects_of(scene), Names{"direct_light"});
    make_surroundings(scene, 0.1);
    EXPECT_EQ(effects_of(scene), (Names{"direct_light", "environment"}));
    add_surroundings(scene, Image<Rgb>(4, 2, Rgb(0.0f)));
    EXPECT_EQ(effects_of(scene), Names{"direct_light"}) << "a black picture";
}

TEST(EffectsPlan, FX17_GlassBeforeABrightWindow) {
    Scene scene = make_lit_square();
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(20.0));
    Material pane{
        .base_color = glm::dvec3(1.0), .gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}};
    scene.materials.push_back(pane);
    const int node = add_mesh(scene, make_quad(0.5, 0.5, 1), {0.0, 0.0, 8.0});
    EXPECT_FALSE(effects_of(scene).contains("refraction")) << "behind the camera";
    for (const double ior : {1.0, 1.5}) {
        scene.materials[1].gloss.ior = ior;
        scene.nodes[node].transform.translation = glm::dvec3(0.0, 0.9, 0.0);
        EXPECT_TRUE(effects_of(scene).contains("refraction")) << ior;
        const FrameOutput seen = Sequence(scene, planned_settings()).render(0);
        double brightest = 0.0;
        for (int x = 10; x < 14; ++x) brightest = std::max(brightest, double{seen.shaded.color(x, 2).x});
        EXPECT_GT(brightest, 15.0) << "the window behind the pane";
    }
}

}  // namespace
}  // namespace aleph
