// The colours of what is left out, pixel by pixel.

#include "render/plan/effect_picture.h"

#include <gtest/gtest.h>

#include <set>

namespace aleph {
namespace {

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

TEST(EffectPicture, IsBlackWhereAllIsSimulated) {
    for (const Rgb& pixel : Frame().picture().pixels) EXPECT_EQ(pixel, Rgb(0.0f));
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
