// The table of effects: what one more row needs.
// The colours of what is left out, pixel by pixel.

#include <nlohmann/json.hpp>

#include "render/cli/explain/explain.h"
#include "render/plan/effect_table.h"
#include "render/plan/effects_plan.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(EffectTable, HasARowForEveryEffectAndThePageDescribesIt) {
    const std::string page = read_bytes(source_folder() / "render/plan/README.md");
    ASSERT_EQ(effect_table().size(), effect_count);
    for (std::size_t i = 0; i < effect_count; ++i) {
        const EffectName& effect = effect_table()[i].effect;
        EXPECT_EQ(effect.id, static_cast<Effect>(i));
        const std::string row = std::string("\n| `") + effect.name + "` | " + effect.description + " | ";
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
}

constexpr Effect lamp_reach{effect_count};
constexpr double cut_radiance = 0.01;

/// An effect that the renderer does not have: lamps whose light ends at a range.
EffectRow make_example() {
    return {.effect = {lamp_reach, "lamp_reach", "lamps whose light ends at a distance"},
            .find =
                [](Planning& frame) {
                    const bool ends =
                        std::ranges::any_of(frame.in.facts.lights, [](const LightFacts& l) { return l.range > 0.0; });
                    return simulate_if_visible(frame, ends ? cut_radiance : 0.0, "lamps end", "no lamp ends");
                },
            .color = {0.2f, 0.4f, 0.6f},
            .shows = [](const MaterialFacts& material, const FrameFacts&) { return material.diffuse > 0.0f; },
            .remove =
                [](Scene& scene) {
                    for (Light& light : scene.lights) light.range = Track<double>(0.0);
                },
            .turn_off = [](RenderSettings& settings) { settings.sampling.spp = 7; }};
}

/// A lamp with a range, and two objects: one is diffuse, one black.
struct ExampleFrame {
    ExampleFrame() {
        table.push_back(make_example());
        facts.lights = {{.kind = LightFacts::Kind::point, .strength = 1.0, .range = 3.0}};
        scene.meshes.resize(1);
        facts.objects.resize(2);
        facts.objects[1].instance = 1;
        facts.objects[0].material.diffuse = 0.5f;
        scene.lights.emplace_back().range = Track<double>(3.0);
    }
    EffectsPlan plan(double threshold) const {
        return plan_effects(scene, settings, {.facts = facts, .shutter = {}, .lens = {}},
                            VisibleFrame{threshold, threshold, 1.0}, table);
    }

    EffectTable table = effect_table();
    Scene scene;
    RenderSettings settings;
    FrameFacts facts;
};

TEST(EffectTable, ARowGoesThroughThePlanAndTheUserOverridesIt) {
    ExampleFrame frame;
    EXPECT_EQ(frame.plan(0.01).of(lamp_reach).decision, Decision::simulate);
    const PlannedEffect faint = frame.plan(1.0).of(lamp_reach);
    EXPECT_EQ(faint.decision, Decision::skip);
    EXPECT_EQ(faint.bound->luminance, cut_radiance);
    EXPECT_TRUE(frame.plan(1.0).left_out().contains(lamp_reach));
    EXPECT_EQ(frame.plan(1.0).left_out_thresholds(), cut_radiance);
    frame.settings.effects.force = EffectSet(lamp_reach);
    EXPECT_EQ(frame.plan(1.0).of(lamp_reach).decision, Decision::simulate);
    frame.settings.effects.forbid = EffectSet(lamp_reach);
    EXPECT_EQ(frame.plan(1.0).of(lamp_reach).reason, "forbidden");
    remove_forbidden(frame.settings.effects.forbid, frame.scene, frame.table);
    EXPECT_EQ(frame.scene.lights[0].range, Track<double>(0.0));
    EXPECT_EQ(without_forbidden(frame.settings, frame.table).sampling.spp, 7);
    frame.facts.lights[0].range = 0.0;
    frame.settings = {};
    EXPECT_EQ(frame.plan(1.0).of(lamp_reach).reason, "no lamp ends");
}

TEST(EffectTable, ARowHasItsJsonItsLineAndItsColour) {
    const ExampleFrame frame;
    const EffectsPlan plan = frame.plan(1.0);
    nlohmann::ordered_json item = to_json(plan).back();
    EXPECT_EQ(item.dump(),
              R"({"effect":"lamp_reach","decision":"skip","reason":"lamps end, but too little to be seen",)"
              R"("bound":{"luminance":0.01,"thresholds":0.01}})");
    item["frames"] = {3, 4};
    const std::string text = plan_text(nlohmann::ordered_json::array({item}), {3, 4});
    EXPECT_NE(text.find("  lamp_reach         3-4         skip      lamps end, but too little to be seen [0.01 cd/m2"),
              std::string::npos)
        << text;
    EffectsPlan alone;
    alone.effects.resize(frame.table.size());
    alone.of(lamp_reach) = plan.of(lamp_reach);
    Image<Hit> hits(2, 1);
    hits(0, 0).instance = 0;
    hits(1, 0).instance = 1;
    const Image<Rgb> picture = make_effect_picture(hits, frame.facts, alone, 2, frame.table);
    EXPECT_EQ(picture(0, 0), frame.table.back().color);
    EXPECT_EQ(picture(1, 0), Rgb(0.0f));
}

/// Objects 0: diffuse; 1: a mirror; 2: glossy plastic; 3: neither; seen by one pixel each, with one of the background.
struct Frame {
    Frame() {
        facts.objects.resize(4);
        for (int i = 0; i < 4; ++i) facts.objects[i].instance = i;
        facts.objects[0].material.diffuse = facts.objects[2].material.diffuse = 0.5f;
        facts.objects[1].material.mirror = true;
        facts.objects[2].material.glossy = true;
        facts.lights.resize(1);
        for (int i = 0; i < 4; ++i) hits(i, 0).instance = i;
        plan.effects.resize(effect_count);
    }
    void leave_out(Effect effect, double luminance = 1.0) {
        plan.of(effect).decision = Decision::skip;
        plan.of(effect).bound = EffectBound{luminance, 0.0};
    }
    Image<Rgb> picture() const { return make_effect_picture(hits, facts, plan, 4); }

    FrameFacts facts;
    EffectsPlan plan;
    Image<Hit> hits{5, 1};
};

Rgb color_of(Effect effect) {
    return effect_table()[static_cast<std::size_t>(effect)].color;
}

TEST(EffectPicture, AnEffectColoursTheSurfacesThatHaveIt) {
    const Rgb none(0.0f);
    struct Case {
        Effect effect;
        std::array<bool, 4> has;
    };
    const Case cases[] = {{Effect::direct_light, {true, true, true, false}},
                          {Effect::area_shadows, {true, true, true, false}},
                          {Effect::indirect_diffuse, {true, false, true, false}},
                          {Effect::more_bounces, {true, false, true, false}},
                          {Effect::caustics, {true, false, true, false}},
                          {Effect::glossy_reflection, {false, false, true, false}},
                          {Effect::mirror_reflection, {false, true, false, false}},
                          {Effect::refraction, {false, false, false, false}},
                          {Effect::motion_blur, {true, true, true, true}},
                          {Effect::depth_of_field, {true, true, true, true}}};
    for (const auto& [effect, has] : cases) {
        Frame frame;
        frame.leave_out(effect);
        const Image<Rgb> picture = frame.picture();
        EXPECT_NE(color_of(effect), none);
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(picture(i, 0), has[i] ? color_of(effect) : none) << static_cast<int>(effect) << ' ' << i;
        EXPECT_EQ(picture(4, 0), none);  // behind all surfaces
    }
}

TEST(EffectPicture, SeveralEffectsAreMixed) {
    Frame frame;
    frame.leave_out(Effect::indirect_diffuse);
    frame.leave_out(Effect::glossy_reflection);
    const Image<Rgb> picture = frame.picture();
    EXPECT_EQ(picture(0, 0), color_of(Effect::indirect_diffuse));
    EXPECT_EQ(picture(2, 0), (color_of(Effect::indirect_diffuse) + color_of(Effect::glossy_reflection)) / 2.0f);
}

TEST(EffectPicture, WhatIsNotThereIsNotLeftOut) {
    Frame frame;
    frame.leave_out(Effect::indirect_diffuse, 0.0);
    frame.leave_out(Effect::area_shadows, 0.0);
    for (const Rgb& pixel : frame.picture().pixels) EXPECT_EQ(pixel, Rgb(0.0f));
    // Shadow rays that change nothing are left out all the same.
    frame.plan.of(Effect::area_shadows).spares = true;
    EXPECT_EQ(frame.picture()(0, 0), color_of(Effect::area_shadows));
    frame.facts.lights.clear();
    EXPECT_EQ(frame.picture()(0, 0), Rgb(0.0f));
    // Without a bound nobody knows.
    Frame unbounded;
    unbounded.leave_out(Effect::indirect_diffuse);
    unbounded.plan.of(Effect::indirect_diffuse).bound.reset();
    EXPECT_EQ(unbounded.picture()(0, 0), color_of(Effect::indirect_diffuse));
}

}  // namespace
}  // namespace aleph
