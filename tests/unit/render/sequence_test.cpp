// A sequence of frames as C++ programs use it.

#include "render/sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/support/quick_settings.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

/// A lamp over a floor, and a box that moves across it.
Scene make_moving_scene() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(10.0));
    scene.meshes = {make_quad(8.0, 8.0, grey), make_box(glm::dvec3(0.6), grey), make_quad(1.0, 1.0, lamp)};
    scene.nodes.resize(4);
    const glm::dquat down = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));
    scene.nodes[0].name = "floor";
    scene.nodes[0].meshes = {0};
    scene.nodes[0].rotation = glm::inverse(down);
    scene.nodes[1].name = "box";
    scene.nodes[1].meshes = {1};
    scene.nodes[1].translation.values = {{-1.0, 0.5, 0.0}, {1.0, 0.5, 0.0}};
    scene.nodes[1].translation.sampling.period = 1.0;
    scene.nodes[2].name = "lamp";
    scene.nodes[2].meshes = {2};
    scene.nodes[2].translation = glm::dvec3(0.0, 3.0, 0.0);
    scene.nodes[2].rotation = down;
    scene.cameras.emplace_back();
    scene.nodes[3].name = "eye";
    scene.nodes[3].camera = 0;
    scene.nodes[3].translation = glm::dvec3(0.0, 1.0, 5.0);
    return scene;
}

/// What the frames of a sequence show.
std::vector<Image<Rgb>> render_two(Sequence& sequence) {
    std::vector<Image<Rgb>> pictures;
    for (const int frame : {0, 15}) pictures.push_back(sequence.render(frame).shaded.color);
    return pictures;
}

TEST(Sequence, OwnsItsScene) {
    const RenderSettings settings = quick_settings(40, 30);
    const Scene kept = make_moving_scene();
    Sequence of_kept(kept, settings);
    const std::vector<Image<Rgb>> expected = render_two(of_kept);
    EXPECT_FALSE(expected[0].pixels == expected[1].pixels) << "nothing moves";

    Sequence of_temporary(make_moving_scene(), settings);
    EXPECT_TRUE(render_two(of_temporary)[1].pixels == expected[1].pixels);
    EXPECT_TRUE(Sequence(make_moving_scene(), settings).render(15).shaded.color.pixels == expected[1].pixels);

    // What becomes of the caller's scene has no influence: every part that a frame reads is changed.
    auto changed = std::make_unique<Scene>(make_moving_scene());
    Sequence of_changed(*changed, settings);
    for (Node& node : changed->nodes) node.translation = glm::dvec3(1e6);
    for (Material& material : changed->materials) material.base_color = material.emission = glm::dvec3(0.0);
    for (Mesh& mesh : changed->meshes) std::ranges::fill(mesh.positions, glm::vec3(0.0f));
    changed->nodes.clear();
    changed->meshes.clear();
    changed.reset();
    const std::vector<Image<Rgb>> pictures = render_two(of_changed);
    EXPECT_TRUE(pictures[0].pixels == expected[0].pixels);
    EXPECT_TRUE(pictures[1].pixels == expected[1].pixels);
}

TEST(Sequence, MovesWithItsScene) {
    const RenderSettings settings = quick_settings(40, 30);
    Sequence first(make_moving_scene(), settings);
    const std::vector<Image<Rgb>> expected = render_two(first);
    Sequence second(std::move(first));
    EXPECT_TRUE(render_two(second)[1].pixels == expected[1].pixels);
    EXPECT_EQ(second.scene().nodes.size(), 4u);
}

}  // namespace
}  // namespace aleph
