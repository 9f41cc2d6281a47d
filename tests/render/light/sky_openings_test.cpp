// Openings towards the sky: where they are found, and that samples towards them have the density that is told.

#include <glm/vector_relational.hpp>

#include "render/frame/sequence.h"
#include "tests/support/scenes/window_room.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Receivers on the floor, the left wall and the ceiling.
std::vector<Receiver> make_receivers(const Stage& stage) {
    const glm::vec3 anchor(stage.shading.anchor);
    return {{glm::vec3(0.3f, 1e-3f, 0.2f) - anchor, up},
            {glm::vec3(1.8f, 1e-3f, -0.3f) - anchor, up},
            {glm::vec3(-1.999f, 1.2f, 0.7f) - anchor, {1.0f, 0.0f, 0.0f}},
            {glm::vec3(1.0f, 2.999f, 0.0f) - anchor, -up}};
}

TEST(SkyOpenings, AreTheWindowsOfARoom) {
    const Stage stage(make_room_with_window());
    const std::optional<SkyOpenings> found = find_openings(stage);
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(found->openings.size(), 1u);
    const SkyOpening& window = found->openings.front();
    const glm::vec3 anchor(stage.shading.anchor);
    const float cell = 4.0f / 32.0f + 0.02f;
    EXPECT_EQ(window.side, 1);
    EXPECT_NEAR(window.low.x + anchor.y, 1.0f, cell);
    EXPECT_NEAR(window.high.x + anchor.y, 2.0f, cell);
    EXPECT_NEAR(window.low.y + anchor.z, -0.5f, cell);
    EXPECT_NEAR(window.high.y + anchor.z, 0.5f, cell);
}

TEST(SkyOpenings, ANarrowOneIsFoundWhole) {
    for (const double half : {0.05, 0.1}) {
        const Stage stage(make_room_with_window({half, 0.9}));
        const std::optional<SkyOpenings> found = find_openings(stage);
        ASSERT_TRUE(found.has_value());
        ASSERT_EQ(found->openings.size(), 1u);
        const SkyOpening& slit = found->openings.front();
        const glm::vec3 anchor(stage.shading.anchor);
        const float cell = 3.0f / 32.0f;
        EXPECT_LT(slit.low.x + anchor.y, 0.6f + cell) << half;
        EXPECT_GT(slit.high.x + anchor.y, 2.4f - cell) << half;
    }
}

TEST(SkyOpenings, ThoseOfTwoTimesBecomeOne) {
    const Stage left(make_room_with_blind(place_blind(0.6))), right(make_room_with_blind(place_blind(-0.6)));
    std::optional<SkyOpenings> both = find_openings(left);
    const std::optional<SkyOpenings> other = find_openings(right);
    ASSERT_TRUE(both.has_value() && other.has_value());
    const glm::vec3 anchor(left.shading.anchor);
    EXPECT_LT(both->openings.front().high.y + anchor.z, 0.3f);
    EXPECT_GT(other->openings.front().low.y + anchor.z, -0.3f);
    add_openings(*other, both);
    ASSERT_EQ(both->openings.size(), 1u);
    const float cell = 4.0f / 32.0f + 0.02f;
    EXPECT_NEAR(both->openings.front().low.y + anchor.z, -0.5f, 2.0f * cell);
    EXPECT_NEAR(both->openings.front().high.y + anchor.z, 0.5f, 2.0f * cell);

    std::optional<SkyOpenings> none;
    add_openings(*other, none);
    ASSERT_TRUE(none.has_value());
    EXPECT_EQ(none->openings.front().low, other->openings.front().low);
}

TEST(SkyOpenings, MoveAsOne) {
    const Stage stage(make_room_with_window());
    const SkyOpenings found = find_openings(stage).value();
    SkyOpenings moved = found;
    const glm::vec3 shift(16.0f, -32.0f, 48.0f);
    move_openings(shift, moved);
    const Receiver receiver = make_receivers(stage).front(), there{receiver.position + shift, receiver.normal};
    const SeenOpenings seen = see_openings(found, receiver), seen_there = see_openings(moved, there);
    for (const glm::vec2 u : {glm::vec2(0.1f, 0.3f), glm::vec2(0.8f, 0.6f)}) {
        const glm::vec3 direction = sample_openings(found, seen, receiver.position, u),
                        same = sample_openings(moved, seen_there, there.position, u);
        EXPECT_NEAR(glm::distance(direction, same), 0.0f, 1e-4f);
        EXPECT_NEAR(pdf_openings(moved, seen_there, there.position, direction),
                    pdf_openings(found, seen, receiver.position, direction), 1e-2f);
    }
}

TEST(SkyOpenings, AreFoundThroughPanes) {
    Scene scene = make_room_with_window();
    const int pane = add_lambert(scene, glm::dvec3(0.0));
    scene.materials[pane].glass.transmission = 1.0;
    scene.materials[pane].gloss.roughness = 0.0;
    add_mesh(scene, make_quad(1.2, 1.2, pane), {2.0 + 0.5 * wall, 1.5, 0.0}, turn_about_y(0.5 * pi));
    EXPECT_TRUE(find_openings(Stage(std::move(scene))).has_value());
}

TEST(SkyOpenings, AreNotLookedForWhereThereIsNoRoomOrNoSky) {
    Scene ground;
    add_mesh(ground, make_quad(10.0, 10.0, add_lambert(ground, glm::dvec3(0.5))), glm::dvec3(0.0), z_to_up);
    ground.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    add_camera(ground, {0.0, 2.0, 4.0}, {0.0, 0.0, 0.0});
    EXPECT_FALSE(find_openings(Stage(std::move(ground))).has_value());
    Scene dark = make_room_with_window();
    dark.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.0));
    add_lamp(dark, 0.2, glm::dvec3(4.0), {0.0, 2.5, 0.0});
    EXPECT_FALSE(find_openings(Stage(std::move(dark))).has_value());
}

TEST(SkyOpenings, SamplesHaveTheDensityThatIsTold) {
    const Stage stage(make_room_with_window());
    SkyOpenings openings = find_openings(stage).value();
    // A second opening that overlaps the first.
    SkyOpening other = openings.openings.front();
    for (glm::vec3& corner : other.corners) corner.y -= 0.4f;
    other.low.x -= 0.4f;
    other.high.x -= 0.4f;
    openings.openings.push_back(other);
    RandomStream random({3, 0, 0, 0});
    for (const Receiver& receiver : make_receivers(stage)) {
        const SeenOpenings seen = see_openings(openings, receiver);
        Mean all, upper, sampled_upper;  // of the sphere, and of its part above the window's middle
        const auto is_upper = [&](const glm::vec3& d) {
            return (receiver.position + d * ((openings.high.x - receiver.position.x) / d.x)).y +
                       static_cast<float>(stage.shading.anchor.y) >
                   1.5f;
        };
        for (int i = 0; i < 400'000; ++i) {
            const glm::vec2 u = random.next_2d();
            const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
            const glm::vec3 d(z, r * std::cos(2.0f * pi * u.y), r * std::sin(2.0f * pi * u.y));
            const double density = pdf_openings(openings, seen, receiver.position, d) * 4.0 * pi;
            all.add(density);
            upper.add(density > 0.0 && is_upper(d) ? density : 0.0);
        }
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec3 d = sample_openings(openings, seen, receiver.position, random.next_2d());
            ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
            ASSERT_GT(pdf_openings(openings, seen, receiver.position, d), 0.0f);
            sampled_upper.add(is_upper(d) ? 1.0 : 0.0);
        }
        EXPECT_NEAR(all.mean(), 1.0, 4.0 * all.error());
        EXPECT_LT(all.error(), 0.03);
        EXPECT_NEAR(sampled_upper.mean(), upper.mean(), 4.0 * std::hypot(upper.error(), sampled_upper.error()));
    }
}

TEST(SkyOpenings, ASmallOneIsSampledByArea) {
    const Stage stage(make_room_with_window());
    SkyOpenings openings = find_openings(stage).value();
    SkyOpening& small = openings.openings.front();
    small.high = small.low + 0.02f;
    for (std::size_t i = 1; i < 4; ++i) {
        const glm::vec3 off = small.corners[i] - small.corners[0];
        small.corners[i] = small.corners[0] + glm::vec3(glm::greaterThan(off, glm::vec3(0.0f))) * 0.02f;
    }
    RandomStream random({4, 0, 0, 0});
    for (const Receiver& receiver : make_receivers(stage)) {
        const SeenOpenings seen = see_openings(openings, receiver);
        const auto to = [&](int i) { return small.corners[i] - receiver.position; };
        Mean solid_angles;
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 d = sample_openings(openings, seen, receiver.position, random.next_2d());
            solid_angles.add(1.0 / pdf_openings(openings, seen, receiver.position, d));
        }
        const double expected = solid_angle(to(0), to(1), to(2)) + solid_angle(to(0), to(2), to(3));
        EXPECT_LT(expected, 2e-3);
        EXPECT_NEAR(solid_angles.mean(), expected, 2e-3 * expected);
    }
}

/// Illuminance of the sky, sample by sample.
Mean light_of_sky(const Stage& stage, Receiver receiver, const SkyOpenings* openings) {
    receiver.openings = openings;
    Mean light;
    RayTask task(stage.rays);
    RandomStream random({5, 0, 0, 0});
    for (int i = 0; i < 50'000; ++i) {
        const LightSample sample = sample_light(stage.shading, stage.lights, 0, receiver, random.next_2d());
        const float cosine = glm::dot(sample.direction, receiver.normal);
        const bool arrives = cosine > 0.0f && !task.tracer.occluded({receiver.position, sample.direction});
        light.add(arrives ? sample.incoming.x * cosine : 0.0f);
    }
    return light;
}

TEST(SkyOpenings, KeepTheLightAndTakeItsNoise) {
    for (const bool picture : {false, true}) {
        Scene scene = make_room_with_window();
        if (picture) add_surroundings(scene, Image<Rgb>(8, 4, Rgb(1.0f)));
        const Stage stage(std::move(scene));
        const SkyOpenings openings = find_openings(stage).value();
        for (const Receiver& receiver : make_receivers(stage)) {
            const Mean plain = light_of_sky(stage, receiver, nullptr), aimed = light_of_sky(stage, receiver, &openings);
            EXPECT_NEAR(aimed.mean(), plain.mean(), 4.0 * std::hypot(plain.error(), aimed.error()));
            EXPECT_LT(2.0 * aimed.error(), plain.error());
        }
    }
}

TEST(SkyOpenings, TellAboutHowMuchTheyLetIn) {
    const Stage stage(make_room_with_window());
    const SkyOpenings openings = find_openings(stage).value();
    for (const Receiver& receiver : make_receivers(stage)) {
        const double share = light_of_sky(stage, receiver, nullptr).mean() / pi;
        const float told = estimate_open_share(openings, receiver, glm::vec3(0.0f));
        EXPECT_GT(told, 0.8 * share);
        EXPECT_LT(told, 2.0 * share + 0.05);
        const glm::vec3 window = glm::vec3(2.0f, 1.5f, 0.0f) - glm::vec3(stage.shading.anchor);
        EXPECT_EQ(estimate_open_share(openings, receiver, glm::normalize(window - receiver.position)), 1.0f);
        EXPECT_LT(estimate_open_share(openings, receiver, glm::normalize(glm::vec3(1.0f, 0.1f, 2.0f))), 0.05f);
        EXPECT_GT(estimate_open_share(openings, receiver, glm::normalize(glm::vec3(1.0f, 0.1f, 2.0f))), 0.0f);
    }
    const Receiver outside{openings.high + 1.0f, up};
    EXPECT_EQ(estimate_open_share(openings, outside, glm::vec3(0.0f)), 1.0f);
    EXPECT_EQ(estimate_open_share(openings, outside, up), 1.0f);
}

TEST(SkyOpenings, ARoomWithAWindowTakesFewSamples) {
    RenderSettings settings;
    settings.picture = {24, 18};
    follow_error(settings, 1.0);
    Sequence sequence(make_room_with_window(glm::dvec2(0.25)), settings);
    const FrameOutput out = sequence.render(0);
    EXPECT_LT(out.statistics.counts.samples, 100u * 24 * 18);
    ASSERT_TRUE(out.statistics.error.has_value());
    EXPECT_LT(out.statistics.error->beyond, 0.01);
    // The estimate, from which exposure and thresholds follow, has the window's light too.
    Mean estimate, picture;
    for (const Rgb& pixel : out.estimate.pixels) estimate.add(luminance(pixel));
    for (const Rgb& pixel : out.shaded.color.pixels) picture.add(luminance(pixel));
    EXPECT_GT(estimate.mean(), 0.4 * picture.mean());
    EXPECT_LT(estimate.mean(), picture.mean());
}

/// A square opening on the lower side of x, in a box of 32 m with cells of 1 m.
SkyOpening open_cells(const glm::vec2& low, const glm::vec2& size, int side = 0) {
    return {side, low, low + size, {}};
}

TEST(SkyOpenings, OneTooManyJoinsTheOneThatGrowsLeast) {
    std::optional<SkyOpenings> openings = SkyOpenings{glm::vec3(0.0f), glm::vec3(32.0f), {}};
    for (const float x : {0.0f, 10.0f})
        for (const float y : {0.0f, 10.0f, 26.0f}) openings->openings.push_back(open_cells({x, y}, glm::vec2(2.0f)));
    openings->openings.push_back(open_cells({20.0f, 26.0f}, glm::vec2(2.0f)));  // with this the union is smaller
    const SkyOpening tall = open_cells({30.0f, 10.0f}, {2.0f, 10.0f});
    openings->openings.push_back(tall);
    ASSERT_EQ(openings->openings.size(), SkyOpenings::most);
    // One on a side of its own is the smallest, and left out.
    for (const int side : {0, 3}) {
        SkyOpenings other = *openings;
        other.openings = {open_cells({31.0f, 26.0f}, glm::vec2(1.0f), side)};
        std::optional<SkyOpenings> all = openings;
        add_openings(other, all);
        EXPECT_EQ(all->openings.size(), SkyOpenings::most);
        EXPECT_EQ(all->openings.front().low, tall.low);  // the largest
        EXPECT_EQ(all->openings.front().high, side == 0 ? glm::vec2(32.0f, 27.0f) : tall.high);
        for (std::size_t i = 1; i < all->openings.size(); ++i)
            EXPECT_EQ(all->openings[i].high - all->openings[i].low, glm::vec2(2.0f)) << i;
    }
}

}  // namespace
}  // namespace aleph
