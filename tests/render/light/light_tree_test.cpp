// The tree over the lights: its bounds, and lights chosen by it.

#include "render/light/light_tree.h"
#include "render/light/light_cut.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Lamps, point lights and spots of all directions in a cube of 4 m, a sun, and if asked for a sky.
Scene make_crowd(int count, bool sky) {
    Scene scene;
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto turn = [&] {
        return glm::normalize(
            glm::dquat(unit(engine) - 0.5, unit(engine) - 0.5, unit(engine) - 0.5, unit(engine) - 0.5));
    };
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(3.0)),
              sheet = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(2.0), true);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 at = 4.0 * glm::dvec3(unit(engine), unit(engine), unit(engine)) - 2.0;
        const glm::dvec3 strength(0.1 + 2.0 * unit(engine));
        switch (i % 5) {
            case 0:
                add_mesh(scene, make_quad(0.1 + 0.4 * unit(engine), 0.2, lamp), at, turn());
                break;
            case 1:
                add_mesh(scene, make_quad(0.3, 0.3, sheet), at, turn());
                break;
            case 2:
                add_mesh(scene, make_box(glm::dvec3(0.2), lamp), at, turn());
                break;
            case 3:
                add_light(scene, Light::Kind::point, strength, at);
                break;
            default:
                add_light(scene, Light::Kind::spot, strength, at, turn());
                scene.lights.back().inner_cone = 0.3;
                scene.lights.back().outer_cone = 0.3 + 0.5 * unit(engine);
        }
    }
    add_light(scene, Light::Kind::directional, glm::dvec3(0.5), glm::dvec3(0.0), turn());
    if (sky) scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.2));
    return scene;
}

glm::vec3 random_direction(std::mt19937& engine) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(engine), normal(engine), normal(engine)));
}

/// Illuminance of each light without shadows; of lamps with the error of 64 samples.
std::vector<double> find_illuminances(const Stage& stage, const Receiver& receiver) {
    std::vector<double> found;
    for (int light = 0; light < stage.lights.count(); ++light) {
        Mean mean;
        for (int i = 0; i < 64; ++i) {
            const LightSample sample =
                sample_light(stage.shading, stage.lights, light, receiver, lattice_point(i, 64, {}));
            const float cosine = std::max(0.0f, glm::dot(sample.direction, receiver.normal));
            mean.add(sample.incoming == Rgb(0.0f) ? 0.0 : luminance(sample.incoming) * cosine);
        }
        found.push_back(mean.mean());
    }
    return found;
}

/// Returns what each light brings, then what the lights of each group bring together.
std::vector<double> add_up(const LightTree& tree, std::vector<double> brought) {
    std::vector<double> groups(tree.groups.size());
    brought.resize(brought.size() + groups.size());
    // Groups follow those above them.
    for (std::size_t g = groups.size(); g-- > 0;) {
        const LightGroup& group = tree.groups[g];
        for (int i = 0; i < group.used; ++i) brought[tree.lights + static_cast<int>(g)] += brought[group.children[i]];
    }
    return brought;
}

TEST(LightTree, NoNodeBringsMoreThanItsBound) {
    const Stage stage(make_crowd(100, true));
    const LightTree& tree = stage.lights.tree;
    std::mt19937 engine(6);
    std::uniform_real_distribution<float> unit(-3.0f, 3.0f);
    double loosest = 0.0;
    for (int i = 0; i < 60; ++i) {
        const Receiver receiver{{unit(engine), unit(engine), unit(engine)}, random_direction(engine)};
        const std::vector<double> brought = add_up(tree, find_illuminances(stage, receiver));
        double bounds = 0.0;
        for (const LightGroup& group : tree.groups) {
            const LightReaches reaches = reach_of(group, receiver);
            for (int k = 0; k < LightGroup::size; ++k) {
                if (k >= group.used) {
                    ASSERT_EQ(reaches.estimates[k], 0.0f);
                    continue;
                }
                const double brings = brought[group.children[k]];
                // Samples of a lamp that is close and sampled by area have an error.
                ASSERT_LE(brings, 1.05 * reaches.bounds[k] + 1e-6);
                ASSERT_TRUE(brings == 0.0 || reaches.estimates[k] > 0.0f);
                if (tree.is_light(group.children[k])) bounds += reaches.bounds[k];
            }
        }
        loosest = std::max(loosest, bounds / brought[tree.lights]);
    }
    EXPECT_LT(loosest, 60.0);
}

/// Float images may be brighter than white.
TEST(LightTree, TheBoundOfATexturedLampIsThatOfItsBrightestTexel) {
    for (const float value : {1.0f, 20.0f}) {
        Scene scene;
        SceneImage image{.floats = Image<glm::vec4>(2, 2)};
        for (glm::vec4& texel : image.floats.pixels) texel = glm::vec4(0.5f * value);
        image.floats(1, 1) = glm::vec4(value);
        scene.images.push_back(image);
        add_lamp(scene, 0.5, glm::dvec3(1.0), {0.0, 2.0, 0.0});
        scene.materials[0].textures[TextureSlot::emission] = {.image = 0, .nearest = true};
        const Stage stage(std::move(scene));
        const Receiver receiver{{0.3f, 0.0f, 0.1f}, up};
        const double brought = find_illuminances(stage, receiver).front();
        const LightReaches reaches = reach_of(stage.lights.tree.groups.front(), receiver);
        EXPECT_GT(brought, 0.0);
        EXPECT_GE(reaches.bounds[0], brought);
        EXPECT_LT(reaches.bounds[0], 3.0 * brought);
    }
}

/// Nearly all light comes from one texel that the surface faces.
TEST(LightTree, TheBoundOfASkyIsAllOfItsLight) {
    Scene scene;
    Image<Rgb> sky(16, 8, Rgb(0.01f));
    sky(5, 3) = Rgb(40.0f);
    add_surroundings(scene, sky);
    const Stage stage(std::move(scene));
    const LightSample towards = sample_light(stage.shading, stage.lights, 0, {glm::vec3(0.0f), up}, {0.5f, 0.5f});
    const Receiver receiver{glm::vec3(0.0f), towards.direction};
    const double brought = find_illuminances(stage, receiver).front();
    const LightReaches reaches = reach_of(stage.lights.tree.groups.front(), receiver);
    EXPECT_GE(reaches.bounds[0], brought);
    EXPECT_LT(reaches.bounds[0], 1.5 * brought);
}

TEST(LightTree, IsNoDeeperThanTheLogarithmOfItsLights) {
    for (const int count : {1, 2, 17, 100, 1000}) {
        const Stage stage(make_crowd(count, false));
        const LightTree& tree = stage.lights.tree;
        std::vector<int> met(static_cast<std::size_t>(tree.lights));
        int deepest = 0;
        const std::function<void(int, int)> visit = [&](int child, int depth) {
            deepest = std::max(deepest, depth);
            if (tree.is_light(child)) {
                ++met[child];
                return;
            }
            const LightGroup& group = tree.group(child);
            for (int i = 0; i < group.used; ++i) visit(group.children[i], depth + 1);
        };
        visit(tree.lights, 0);
        for (const int times : met) EXPECT_EQ(times, 1);
        EXPECT_LE(deepest, 1 + static_cast<int>(std::ceil(std::log2(count) / 3.0)));
    }
}

TEST(LightTree, LightsAreChosenWithTheProbabilityThatIsSaid) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(-2.0f, 2.0f);
    constexpr int numbers = 20'000;
    for (const int count : {8, 100}) {
        const Stage stage(make_crowd(count, true));
        for (int i = 0; i < 4; ++i) {
            const Receiver receiver{{unit(engine), unit(engine), unit(engine)}, random_direction(engine)};
            const LightCut cut = find_light_cut(stage.lights, receiver);
            std::vector<double> times(static_cast<std::size_t>(stage.lights.count())), said(times.size()),
                rests(times.size());
            for (int k = 0; k < numbers; ++k) {
                const float number = (static_cast<float>(k) + 0.5f) / numbers;
                const LightPick pick = pick_light(cut, receiver, number);
                if (pick.light == no_index) continue;
                ASSERT_TRUE(pick.rest >= 0.0f && pick.rest < 1.0f);
                ++times[pick.light];
                said[pick.light] = pick.probability;
                rests[pick.light] += pick.rest;
            }
            const std::vector<double> brought = find_illuminances(stage, receiver);
            for (std::size_t light = 0; light < times.size(); ++light) {
                if (times[light] > 0.0) {
                    EXPECT_NEAR(times[light], numbers * said[light], 2.0);
                } else {
                    EXPECT_LT(brought[light], 1e-4) << light;
                }
                if (times[light] > 50.0) {
                    EXPECT_NEAR(rests[light] / times[light], 0.5, 0.05);
                }
            }
        }
    }
}

/// A small lamp that is tilted, and one whose middle lies in the surface's plane: half of it is above.
TEST(LightCut, FewLightsCountByTheirDistanceAndBothCosines) {
    Scene scene;
    const glm::dvec3 at(0.6, 1.5, 0.3);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(4.0));
    add_mesh(scene, make_quad(0.02, 0.02, lamp), at, glm::angleAxis(0.7, glm::dvec3(0.0, 0.0, 1.0)) * z_to_down);
    add_mesh(scene, make_quad(0.2, 0.2, lamp), {0.0, 0.0, -2.0});
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), at);
    const Stage stage(std::move(scene));
    const Receiver receiver{-glm::vec3(stage.shading.anchor), up};
    const LightCut cut = find_light_cut(stage.lights, receiver);
    ASSERT_EQ(cut.size, 3);
    const double distance2 = glm::dot(at, at), cosine = at.y / std::sqrt(distance2);
    const double at_lamp = glm::dot(at, glm::dvec3(-std::sin(0.7), std::cos(0.7), 0.0)) / std::sqrt(distance2);
    const double wide = 0.01 * std::numbers::sqrt2 / std::sqrt(distance2);  // half of the lamp's diagonal
    EXPECT_NEAR(cut.weights[0], 4.0 * 4e-4 * (cosine + wide) * (at_lamp + wide) / distance2, 1e-4 * cut.weights[0]);
    EXPECT_NEAR(cut.weights[1], 4.0 * 4e-2 * (0.1 * std::numbers::sqrt2 / 2.0) / 4.0, 1e-4 * cut.weights[1]);
    EXPECT_NEAR(cut.weights[2], 3.0 * cosine / distance2, 1e-4 * cut.weights[2]);
}

}  // namespace
}  // namespace aleph
