// The effects plan: tiny scenes, each of which calls for one effect, or for as few as can be. Caustics need a mirror
// and light that it passes on; area shadows a lamp and something before it; further bounces, and cached light that
// lasts, indirect light; saliency motion. The others are alone with the light that shows them. Subdivision and
// deformation are in effects_plan_test.cpp (FX-07, FX-08).

#include "render/plan/effects_plan.h"
#include "tests/support/scenes/planned_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Names = std::set<std::string>;

struct Case {
    const char* name;
    Scene scene;
    RenderSettings settings;
    Names effects;
};

/// Every scene calls for the effects that are named, and for no other.
std::vector<Case> make_cases() {
    std::vector<Case> cases;
    const auto add = [&](const char* name, Scene scene, Names effects) -> RenderSettings& {
        cases.push_back({name, std::move(scene), planned_settings(), std::move(effects)});
        return cases.back().settings;
    };
    add("nothing", make_empty_view(), {});
    add("direct light", make_lit_square(), {"direct_light"});

    Scene scene = make_empty_view();
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))));
    add("emission", scene, {"emission"});

    scene = make_empty_view();
    make_surroundings(scene, 1.0);
    add("environment", scene, {"environment"});

    scene = make_lit_square();
    scene.lights.clear();
    scene.nodes.back().light = no_index;
    add_mesh(scene, make_quad(0.5, 0.5, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(9.0))), {0.0, 0.0, 4.0},
             z_to_up * z_to_up);
    add("a lamp", scene, {"direct_light", "emission"});
    add_mesh(scene, make_faceted_sphere(0.1, 8, add_lambert(scene, glm::dvec3(0.0))), {0.0, 0.3, 1.0});
    add("a lamp behind a ball", scene, {"direct_light", "emission", "area_shadows"});

    scene = make_lit_square();
    add_mesh(scene, make_quad(1.0, 1.0, 0), {0.5, 0.0, 0.5}, glm::angleAxis(-1.5, glm::dvec3(0.0, 1.0, 0.0)));
    add("two squares that see each other", scene, {"direct_light", "indirect_diffuse"});
    add("the same, bounces", scene, {"direct_light", "indirect_diffuse", "more_bounces"}).light.bounces = 3;
    add("the same, lighting keyframes", scene, {"direct_light", "indirect_diffuse", "cache_carry_over"})
        .cache.light_step = 10;
    scene.meshes[1].material = add_material(scene, 1.0, 0.0);
    scene.nodes.back().transform.translation = glm::dvec3(20.0, 0.0, 0.5);
    add("a mirror out of view", scene, {"direct_light", "indirect_diffuse", "caustics"});

    scene = make_lit_square();
    scene.meshes[0].material = add_material(scene, 0.0, 0.4);
    add("gloss", scene, {"direct_light", "glossy_reflection"});
    scene.meshes[0].material = add_material(scene, 1.0, 0.0);
    make_surroundings(scene, 1.0);
    add("a mirror", scene, {"direct_light", "environment", "mirror_reflection"});
    Material glass{.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}};
    scene.materials.push_back(glass);
    scene.meshes[0].material = static_cast<int>(scene.materials.size()) - 1;
    add("glass", scene, {"direct_light", "environment", "refraction"});

    scene = make_lit_square();
    scene.materials[0].textures[TextureSlot::base_color] = add_texture(scene, {200, 100, 50, 255});
    add("a texture", scene, {"direct_light", "textures"});
    scene.materials[0].textures[TextureSlot::base_color] = {};
    scene.materials[0].textures[TextureSlot::normal] = add_texture(scene, {128, 128, 255, 255});
    add("a normal map", scene, {"direct_light", "normal_maps"});
    scene = make_lit_square();
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    add("a mask", scene, {"direct_light", "alpha"});

    scene = make_lit_square();
    scene.nodes[1].transform.translation = Track<glm::dvec3>({0.0, 0.1}, {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)});
    add("motion", scene, {"direct_light", "motion"}).perception.guide = Guide::full;
    add("motion that matters to viewers", scene, {"direct_light", "motion", "saliency"}).perception.guide =
        Guide::saliency;
    scene = make_lit_square();
    scene.cameras[0].shutter = {0.0, 0.5};
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({0.0, 0.1}, {glm::dvec3(0.0, 0.0, 3.0), glm::dvec3(1.0, 0.0, 3.0)});
    add("motion blur", scene, {"direct_light", "motion_blur"});
    scene = make_lit_square();
    scene.cameras[0].aperture = 0.2;
    scene.cameras[0].focus_distance = 1.0;
    add("a lens", scene, {"direct_light", "depth_of_field"});
    return cases;
}

TEST(EffectsPlan, EachTinySceneCallsForItsEffectsAlone) {
    for (const Case& c : make_cases()) {
        Sequence sequence(c.scene, c.settings);
        const FrameStatistics statistics = sequence.render(0).statistics;
        EXPECT_EQ(simulated(statistics.plan), c.effects) << c.name;
        EXPECT_EQ(simulated(sequence.plan(0)), c.effects) << c.name;
        const RayCounts& rays = statistics.counts.rays;
        // Lighting keyframes are counted by themselves.
        const bool gathers = c.effects.contains("indirect_diffuse") && !c.effects.contains("cache_carry_over");
        EXPECT_EQ(rays.gather > 0, gathers) << c.name;
        const bool lobes = c.effects.contains("glossy_reflection") || c.effects.contains("caustics");
        EXPECT_TRUE(lobes || rays.glossy == 0) << c.name;
        const bool mirrors = c.effects.contains("mirror_reflection") || c.effects.contains("refraction") ||
                             c.effects.contains("caustics");
        EXPECT_TRUE(mirrors || rays.specular == 0) << c.name;
        EXPECT_TRUE(c.effects != Names{"direct_light"} || rays.shadow == 0) << c.name;
        EXPECT_EQ(rays.total(), statistics.traced.all) << c.name;
    }
}

TEST(EffectsPlan, FX13_ForcingWhatWasSkippedChangesNothing) {
    for (const Case& c : make_cases()) {
        RenderSettings forced = c.settings;
        forced.effects.force = all_effects(c.effects);
        Sequence sequence(c.scene, forced);
        const FrameOutput with = sequence.render(0), planned = Sequence(c.scene, c.settings).render(0);
        EXPECT_EQ(simulated(with.statistics.plan).size(), effect_count) << c.name;
        EXPECT_EQ(with.shaded.color.pixels, planned.shaded.color.pixels) << c.name;
        RenderSettings off = c.settings;
        off.effects.plan = EffectsPlanning::off;
        EXPECT_EQ(Sequence(c.scene, off).render(0).shaded.color.pixels, planned.shaded.color.pixels) << c.name;
    }
}

TEST(EffectsPlan, ForbiddenEffectsAreLeftOut) {
    for (const Case& c : make_cases()) {
        for (const std::string& name : c.effects) {
            RenderSettings settings = c.settings;
            std::string unknown;
            settings.effects.forbid = parse_effects(name, unknown);
            const FrameOutput without = Sequence(c.scene, settings).render(0);
            const FrameOutput with = Sequence(c.scene, c.settings).render(0);
            EXPECT_FALSE(simulated(without.statistics.plan).contains(name)) << c.name;
            const bool of_light = name != "motion" && name != "saliency" && name != "cache_carry_over" &&
                                  name != "more_bounces" && name != "normal_maps" && name != "alpha" &&
                                  std::string(c.name) != "a mirror out of view";
            EXPECT_TRUE(!of_light || without.shaded.color.pixels != with.shaded.color.pixels) << c.name << ": " << name;
        }
    }
}

TEST(EffectsPlan, EveryEffectHasATinyScene) {
    Names called_for{"subdivision", "deformation"};  // FX-07, FX-08
    for (const Case& c : make_cases()) called_for.insert(c.effects.begin(), c.effects.end());
    for (const EffectName& effect : effect_list) EXPECT_TRUE(called_for.contains(effect.name)) << effect.name;
}

}  // namespace
}  // namespace aleph
