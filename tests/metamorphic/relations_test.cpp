// Relations between pictures: the authored scenes against changed ones whose pictures must be the same.
// The irradiance cache at work, one sample a pixel. Every relation prints its largest differences. Where random numbers
// change with the scene, mean luminances of 8 seeds are compared in two stages.

#include <iostream>

#include "engine/base/color.h"
#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/metamorphic/changes.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

struct Authored {
    std::string name;
    Scene scene;
    std::int64_t frame = 0;  ///< in the middle of the shot
};

const std::vector<Authored>& authored_scenes() {
    static const std::vector<Authored> scenes = [] {
        std::vector<Authored> all;
        for (const char* folder : {"hard", "effects", "materials"}) {
            for (const auto& entry : std::filesystem::directory_iterator(source_folder() / "scenes" / folder)) {
                if (entry.path().extension() != ".json") continue;
                Authored one{entry.path().stem(), load_scene(entry.path()), 0};
                if (one.scene.film.range)
                    one.frame = (one.scene.film.range->first + one.scene.film.range->last + 1) / 2;
                if (!one.scene.film.exposure) one.scene.film.exposure = 1.0;
                all.push_back(std::move(one));
            }
        }
        std::ranges::sort(all, {}, &Authored::name);
        return all;
    }();
    return scenes;
}

RenderSettings relation_settings() {
    RenderSettings settings = quick_settings(24, 18);
    settings.cache.gather = 32;
    settings.cache.accuracy = 0.3;
    settings.perception.guide = Guide::none;
    return settings;
}

FrameOutput render(const Scene& scene, std::int64_t frame) {
    return Sequence(scene, relation_settings()).render(frame, {.maps = true, .progress = {}});
}

const FrameOutput& original(std::size_t i) {
    static std::map<std::size_t, FrameOutput> outputs;
    const auto found = outputs.find(i);
    if (found != outputs.end()) return found->second;
    const Authored& authored = authored_scenes()[i];
    return outputs.emplace(i, render(authored.scene, authored.frame)).first->second;
}

struct Difference {
    double depth = 0.0;   ///< largest, relative
    double motion = 0.0;  ///< largest, pixels
    double color = 0.0;   ///< largest of a pixel's luminance, relative to the sum of its own and the picture's mean
    double light = 0.0;   ///< of the mean luminance, relative
};

double total(const FrameOutput& output) {
    double sum = 0.0;
    for (const Rgb& pixel : output.shaded.color.pixels) sum += luminance(pixel);
    return sum;
}

Difference compare(const FrameOutput& a, const FrameOutput& b, double lengths) {
    Difference most;
    const double sum_a = total(a), sum_b = total(b), count = static_cast<double>(a.hits.size());
    if (sum_a != sum_b) most.light = std::abs(sum_b / sum_a - 1.0);
    for (std::size_t i = 0; i < a.hits.size(); ++i) {
        const bool misses = a.hits.pixels[i].instance == no_index;
        EXPECT_EQ(misses, b.hits.pixels[i].instance == no_index) << i;
        if (!misses)
            most.depth =
                std::max(most.depth, std::abs(b.surface.depth.pixels[i] / (a.surface.depth.pixels[i] * lengths) - 1.0));
        const glm::dvec2 motion = a.motion.displacement.pixels[i] - b.motion.displacement.pixels[i];
        most.motion = std::max(most.motion, glm::length(motion));
        const double x = luminance(a.shaded.color.pixels[i]), y = luminance(b.shaded.color.pixels[i]);
        if (x != y) most.color = std::max(most.color, std::abs(x - y) / (std::max(x, y) + sum_a / count));
    }
    return most;
}

/// Change of a scene, and how much pictures may differ then.
struct Relation {
    std::function<void(Scene&)> change;
    Difference limit{};
    double lengths = 1.0;
    std::int64_t later = 0;
    bool other_numbers = false;             ///< all pictures have other random numbers: only their means are compared
    std::vector<std::string> random_too{};  ///< scenes of which that is true in any case
    std::vector<std::string> left_out{};
    std::map<std::string, Difference> but{};  ///< wider limits of some scenes
};

Mean mean_light(const Scene& scene, std::int64_t frame, const Trial& trial, std::uint32_t seed) {
    Mean mean;
    RenderSettings settings = relation_settings();
    settings.sampling.spp = 2;
    for (std::uint32_t run = 0; run < trial.times(8u); ++run) {
        settings.seed = trial.seed + seed + run;
        mean.add(total(Sequence(scene, settings).render(frame)));
    }
    return mean;
}

/// The light of an authored scene as it is; several relations ask for it.
const Mean& original_light(std::size_t i, const Trial& trial) {
    static std::map<std::pair<std::size_t, std::uint32_t>, Mean> means;
    const auto [found, is_new] = means.try_emplace({i, trial.seed});
    const Authored& authored = authored_scenes()[i];
    if (is_new) found->second = mean_light(authored.scene, authored.frame, trial, 0);
    return found->second;
}

void expect_relation(const std::string& name, const Relation& relation) {
    Difference most;
    std::string where[4];
    for (std::size_t i = 0; i < authored_scenes().size(); ++i) {
        const Authored& authored = authored_scenes()[i];
        if (std::ranges::count(relation.left_out, authored.name) > 0) continue;
        SCOPED_TRACE(name + ": " + authored.name);
        Scene scene = authored.scene;
        relation.change(scene);
        const std::int64_t frame = authored.frame + relation.later;
        const Difference found = compare(original(i), render(scene, frame), relation.lengths);
        const auto wider = relation.but.find(authored.name);
        const Difference& limit = wider == relation.but.end() ? relation.limit : wider->second;
        const auto check = [&](double Difference::*part, const char* what, int index) {
            EXPECT_LE(found.*part, limit.*part) << what;
            if (found.*part > most.*part) {
                most.*part = found.*part;
                where[index] = " (" + authored.name + ")";
            }
        };
        check(&Difference::depth, "depth, relative", 0);
        check(&Difference::motion, "motion, pixels", 1);
        if (relation.other_numbers || std::ranges::count(relation.random_too, authored.name) > 0) {
            EXPECT_TRUE(holds([&](Trial& trial) {
                const Mean& expected = original_light(i, trial);
                trial.near(mean_light(scene, frame, trial, 1000), expected, 1e-5 * expected.mean());
            }));
            continue;
        }
        check(&Difference::color, "colour, relative", 2);
        check(&Difference::light, "mean luminance, relative", 3);
    }
    std::cout << name << ": depth " << most.depth << where[0] << ", motion " << most.motion << " px" << where[1]
              << ", colour " << most.color << where[2] << ", light " << most.light << where[3] << '\n';
}

TEST(Relations, ThereAreScenes) {
    EXPECT_GE(authored_scenes().size(), 50u);
}

// Blended surfaces stop rays by a hash of their bits: the curtain's random numbers change with its place and size.
// Positions are floats about an anchor, a point of a grid of 16 m near the camera: where the camera's place in its cell
// changes, rounding does. Mirrors and a ball of glass magnify it.
TEST(Relations, LengthsByAPowerOfTwo) {
    const Difference rounding{2e-6, 3e-7, 1e-4, 2e-6};
    for (const int exponent : {-10, -3, 3}) {
        const double factor = std::ldexp(1.0, exponent);
        expect_relation("lengths times 2^" + std::to_string(exponent),
                        {.change = [&](Scene& scene) { scale_lengths(scene, factor); },
                         .limit = exponent < 0 ? Difference{} : rounding,
                         .lengths = factor,
                         .random_too = {"curtain"},
                         .but = {{"far_away", {1e-5, 3e-7, 3e-4, 1e-4}},
                                 {"mirror", {2e-6, 3e-7, 0.02, 2e-4}},
                                 {"glass_ball", {2e-6, 3e-7, 1e-4, 5e-6}}}});
    }
}

TEST(Relations, LightByAPowerOfTwo) {
    for (const int exponent : {-12, 5}) {
        expect_relation("light times 2^" + std::to_string(exponent),
                        {.change = [&](Scene& scene) { scale_light(scene, std::ldexp(1.0, exponent)); }});
    }
}

// Random numbers follow the frame's number where the camera moves.
TEST(Relations, LaterInTime) {
    constexpr int frames = 48;
    expect_relation("48 frames later", {.change = [](Scene& scene) { delay(scene, frames); },
                                        .limit = {0.0, 1e-12, 0.0, 0.0},
                                        .later = frames,
                                        .random_too = {"camera_cut", "creeping", "curtain", "sky", "slow_camera"}});
}

// The motion of the last frame leads from the frame before it. Backwards in time it is the first frame, whose motion
// leads to the next.
TEST(Relations, TimeReversed) {
    double largest = 0.0, fastest = 0.0;
    int scenes = 0;
    for (const Authored& authored : authored_scenes()) {
        SCOPED_TRACE(authored.name);
        Scene scene = authored.scene;
        const bool steps = std::ranges::any_of(scene.nodes, [](const Node& n) { return is_animated(n.visible); }) ||
                           std::ranges::any_of(scene.meshes, [](const Mesh& m) { return is_animated(m.present); });
        if (steps || !scene.film.camera_keys.empty() || !scene.film.cuts.empty() ||
            scene.film.range->first == scene.film.range->last)
            continue;
        ++scenes;
        scene.film.range->last = std::max(authored.frame, scene.film.range->first + 1);
        const std::int64_t frame = scene.film.range->last;
        const FrameOutput forward = render(scene, frame);
        reverse_time(scene);
        scene.film.range = FrameRange{-frame, -scene.film.range->first};
        const FrameOutput backward = render(scene, -frame);
        for (std::size_t i = 0; i < forward.hits.size(); ++i) {
            const MotionField &a = forward.motion, &b = backward.motion;
            ASSERT_EQ(forward.hits.pixels[i].instance, backward.hits.pixels[i].instance) << i;
            EXPECT_EQ(a.validity.pixels[i], b.validity.pixels[i]) << i;
            fastest = std::max(fastest, glm::length(a.displacement.pixels[i]));
            largest = std::max(largest, glm::length(a.displacement.pixels[i] + b.displacement.pixels[i]));
        }
    }
    EXPECT_GT(scenes, 30);
    EXPECT_GT(fastest, 1.0);
    EXPECT_LE(largest, 1e-8);
    std::cout << "time reversed, " << scenes << " scenes: motion " << largest << " px of up to " << fastest << '\n';
}

TEST(Relations, Elsewhere) {
    const glm::dvec3 place(64.0, -16.0, 32.0);  // of the anchors' grid
    expect_relation("moved",
                    {.change = [&](Scene& scene) { place_below(scene, place, glm::dquat(1.0, 0.0, 0.0, 0.0)); },
                     .limit = {0.0, 1e-12, 1e-6, 2e-7},
                     // Normals of single texels, 4 mm wide: of a place's rounding by 5e-7 m they see a ten-thousandth.
                     .but = {{"brick_wall", {0.0, 1e-12, 2e-5, 2e-7}}}});
    const double h = std::sqrt(0.5);
    expect_relation("turned",
                    {.change = [&](Scene& scene) { place_below(scene, glm::dvec3(0.0), glm::dquat(h, 0.0, h, 0.0)); },
                     .limit = {1e-6, 1e-11, 0.0, 0.0},
                     .other_numbers = true});
}

// Where two surfaces lie in one place, the first node's is seen.
TEST(Relations, OrderOfNodes) {
    expect_relation("nodes in the opposite order",
                    {.change = reverse_nodes, .other_numbers = true, .left_out = {"coplanar"}});
}

TEST(Relations, Names) {
    expect_relation("other names", {.change = rename_everything});
}

TEST(Relations, WhatNoNodeUses) {
    expect_relation("unused elements", {.change = add_unused});
}

TEST(Relations, MeshesInTwo) {
    expect_relation("meshes in two", {.change = split_meshes, .other_numbers = true});
}

}  // namespace
}  // namespace aleph
