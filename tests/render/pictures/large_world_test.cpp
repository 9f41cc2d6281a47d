// The same scene at the origin and 1000 km away (KF-25, IC-16).
// Where texture coordinates grow without bound, a texture has its mean colour.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int world_width = 64, world_height = 48;

/// Everything, with the camera, under one node.
Scene make_room_at(const glm::dvec3& place) {
    Scene scene;
    const int root = add_node(scene, place, no_turn);
    const int white = add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(10.0));
    add_mesh(scene, make_box({4.0, 3.0, 4.0}, white), glm::dvec3(0.0), no_turn, root);
    add_mesh(scene, make_faceted_sphere(0.5, 32, white), {-0.6, -1.0, -0.2}, no_turn, root);
    add_mesh(scene, make_box({0.8, 0.8, 0.8}, white), {0.5, -1.1, -0.5}, glm::angleAxis(0.4, glm::dvec3(0.0, 1.0, 0.0)),
             root);
    add_mesh(scene, make_quad(1.0, 1.0, lamp), {0.0, 1.49, 0.0}, z_to_down, root);
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {1.2, 0.5, 1.0}, no_turn, root);
    add_camera(scene, {0.0, 0.0, 1.8}, {0.0, -0.4, 0.0}, 1.0, root);
    return scene;
}

struct Compared {
    int other_hits = 0;       ///< pixels whose first hit is another triangle
    double largest_px = 0.0;  ///< distance between projections of the hit points
    int other_colors = 0;     ///< pixels that differ by more than 1 %
    double mean_difference = 0.0;
};

Compared compare_with_origin(const glm::dvec3& place) {
    const Stage near(make_room_at(glm::dvec3(0.0)), world_width, world_height);
    const Stage far(make_room_at(place), world_width, world_height);
    const RenderSettings settings = plain_settings(0.2, 2048);  // records may differ by noise only
    const Image<Rgb> a = shade(near, settings).color, b = shade(far, settings).color;
    const SampleHits near_hits = cast_centers(near.rays, near.view, nullptr);
    const SampleHits far_hits = cast_centers(far.rays, far.view, nullptr);
    Compared result;
    double sum = 0.0, difference = 0.0;
    for (const auto [x, y] : all_pixels(world_width, world_height)) {
        sum += a(x, y).x;
        difference += a(x, y).x - b(x, y).x;
        if (std::abs(a(x, y).x - b(x, y).x) > 0.01f * a(x, y).x) ++result.other_colors;
        const Hit &p = near_hits.hits(x, y), &q = far_hits.hits(x, y);
        EXPECT_NE(p.instance, no_index);
        if (p.instance != q.instance || p.primitive != q.primitive) {
            ++result.other_hits;
            continue;
        }
        const auto pixel_of = [&](const Stage& stage, const SampleHits& hits) {
            const PixelSurface s = make_pixel_surface(stage.shading, stage.view, hits, x, y);
            return project_camera_point(stage.view,
                                        to_camera(stage.view, glm::dvec3(s.point.position) + stage.shading.anchor));
        };
        const glm::dvec2 moved = pixel_of(near, near_hits) - pixel_of(far, far_hits);
        result.largest_px = std::max(result.largest_px, glm::length(moved));
    }
    result.mean_difference = std::abs(difference) / sum;
    return result;
}

void expect_the_same(const glm::dvec3& place) {
    const Compared found = compare_with_origin(place);
    EXPECT_LE(found.other_hits, world_width * world_height / 100);
    EXPECT_LT(found.largest_px, 1e-3);
    EXPECT_LE(found.other_colors, world_width * world_height / 100);
    EXPECT_LT(found.mean_difference, 1e-3);
}

TEST(LargeWorld, KF25_IC16_AThousandKilometresAway) {
    // A multiple of the anchor's grid: the picture is the same.
    const Compared found = compare_with_origin({1e6, 1e6, -1e6});
    EXPECT_EQ(found.other_hits, 0);
    EXPECT_LT(found.largest_px, 1e-6);
    EXPECT_EQ(found.other_colors, 0);
}

TEST(LargeWorld, KF25_IC16_OffTheAnchorsGrid) {
    expect_the_same({1'000'020.3, -999'987.7, 1'000'031.9});
}

TEST(LargeWorld, KF25_IC16_FarInOneDirectionOnly) {
    expect_the_same({0.0, 0.0, 1'000'001.37});
}

/// Renders a triangle whose texture repeats more and more, of the colours a and b.
Image<Rgb> render_with(float huge, const Rgb& a, const Rgb& b) {
    const ScratchFolder folder;
    GltfDraft draft = textured_draft(folder, true);
    Image<Rgb> checker(2, 2, a);
    checker(0, 1) = checker(1, 0) = b;
    write_png(folder / "image.png", checker);
    draft.primitive()["attributes"]["TEXCOORD_0"] =
        draft.add_accessor<float>({0, 0, huge, -huge, 0.5f * huge, huge}, "VEC2", 2);
    draft.json["nodes"][2] = Json::object();  // loading adds a camera that sees the triangle, and an environment
    write_text(folder / "huge.gltf", draft.to_text());
    Scene scene = load_scene(folder / "huge.gltf");
    Sequence sequence(scene, quick_settings(24, 18));
    return sequence.render(0, {.frame = true, .maps = false, .progress = {}}).shaded.color;
}

TEST(HugeUv, ATextureHasItsMeanColour) {
    const Rgb mean = 0.5f * (Rgb(0.8f, 0.1f, 0.3f) + Rgb(0.2f, 0.7f, 0.1f));
    const Image<Rgb> expected = render_with(1.0f, mean, mean);
    for (const float huge : {1e7f, 1e18f, 1e30f, -1e30f, std::numeric_limits<float>::max()}) {
        SCOPED_TRACE(huge);
        const Image<Rgb> found = render_with(huge, {0.8f, 0.1f, 0.3f}, {0.2f, 0.7f, 0.1f});
        int lit = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // The bytes of the file are rounded.
                ASSERT_NEAR(found.pixels[i][c], expected.pixels[i][c], 0.01f * expected.pixels[i][c] + 1e-6f) << i;
            }
            lit += expected.pixels[i].x > 0.0f;
        }
        EXPECT_GT(lit, 20);
    }
}

}  // namespace
}  // namespace aleph
