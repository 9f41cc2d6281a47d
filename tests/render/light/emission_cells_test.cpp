// Lamps whose emission is uneven over their area: few texels shine.

#include <random>
#include <set>

#include "render/light/light_choice.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

constexpr int texels = 32;
constexpr float spot_radiance = 50.0f;
const std::set<std::pair<int, int>> spots{{3, 4}, {4, 4}, {20, 7}, {11, 25}, {30, 30}};

/// A square lamp of 2 m at a height of 2 m that shines down, where five of its 1024 texels shine.
Scene make_spotted_lamp(bool nearest, Mesh mesh = make_quad(2.0, 2.0, 0)) {
    Scene scene;
    add_lambert(scene, glm::dvec3(0.0), glm::dvec3(spot_radiance));
    SceneImage image{.floats = Image<glm::vec4>(texels, texels)};
    for (const auto& [x, y] : spots) image.floats(x, y) = glm::vec4(1.0f);
    scene.images.push_back(image);
    scene.materials[0].textures[TextureSlot::emission] = {.image = 0, .nearest = nearest};
    for (glm::vec2& uv : mesh.uv[0]) uv += 1.0f;  // the picture repeats, and no corner is at 0
    // Cells are measured in the mesh's own space, where the lamp is a quarter as large.
    for (glm::vec3& p : mesh.positions) p *= 0.25f;
    const int node = add_mesh(scene, std::move(mesh), {0.0, 2.0, 0.0}, z_to_down);
    scene.nodes[node].transform.scale = glm::dvec3(4.0);
    return scene;
}

/// The lamp's point of these texture coordinates.
glm::vec3 lamp_point(float u, float v) {
    return {2.0f * u - 1.0f, 2.0f, 1.0f - 2.0f * v};
}

/// Solid angle of the part of the lamp between these texels, sr.
double find_angle(const glm::vec3& from, int left, int top, int right, int bottom) {
    const auto corner = [&](int x, int y) {
        return lamp_point(static_cast<float>(x) / texels, static_cast<float>(y) / texels) - from;
    };
    const glm::vec3 a = corner(left, top), b = corner(right, top), c = corner(right, bottom), d = corner(left, bottom);
    return double{solid_angle(a, b, c)} + double{solid_angle(a, c, d)};
}

double spots_angle(const glm::vec3& from) {
    double sum = 0.0;
    for (const auto& [x, y] : spots) sum += find_angle(from, x, y, x + 1, y + 1);
    return sum;
}

const glm::vec3 near_and_far[] = {{0.3f, 1.9f, 0.2f}, {0.7f, 1.0f, -0.4f}, {0.0f, -20.0f, 3.0f}};

TEST(EmissionCells, SamplesFindTheSpots) {
    const Stage stage(make_spotted_lamp(true));
    ASSERT_FALSE(stage.lights.emitters[0].shape->cells.empty());
    for (const glm::vec3& place : near_and_far) {
        const Receiver receiver{place - glm::vec3(stage.shading.anchor), up};
        EXPECT_TRUE(holds([&](Trial& trial) {
            RandomStream random({21 + trial.seed, 0, 0, 0});
            Mean light, whole, found;
            for (int i = 0; i < trial.times(20'000); ++i) {
                const LightSample s = sample_light(stage.shading, stage.lights, 0, receiver, random.next_2d());
                light.add(s.incoming.x);
                whole.add(s.pdf > 0.0f ? 1.0 / s.pdf : 0.0);
                found.add(s.incoming.x > 0.0f ? 1.0 : 0.0);
            }
            trial.near(light, spot_radiance * spots_angle(place));
            trial.near(whole, find_angle(place, 0, 0, texels, texels));  // no part is left out
            EXPECT_GT(found.mean(), place.y < 0.0f ? 0.8 : 0.4);         // by the whole area .005
        })) << place.y;
    }
}

TEST(EmissionCells, RaysFindTheDensityOfSamples) {
    const Mesh quad = make_quad(2.0, 2.0, 0);
    Mesh folded = make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 0.7, .segments = 12}, 0);
    for (const bool nearest : {false, true}) {
        for (const Mesh& mesh : {quad, folded}) {
            const Stage stage(make_spotted_lamp(nearest, mesh));
            const Emitter& emitter = stage.lights.emitters[0];
            ASSERT_FALSE(emitter.shape->cells.empty());
            RayCounts counts;
            Tracer tracer(stage.rays);
            int compared = 0, others = 0;
            for (const glm::vec3& place : {near_and_far[1], near_and_far[2]}) {
                const Receiver receiver{place - glm::vec3(stage.shading.anchor), up};
                RandomStream random({22, 0, 0, 0});
                for (int i = 0; i < 2000; ++i) {
                    const LightSample s = sample_light(stage.shading, stage.lights, 0, receiver, random.next_2d());
                    if (!(s.pdf > 0.0f)) continue;
                    const Hit hit = tracer.intersect({receiver.position, s.direction});
                    if (hit.instance == no_index || std::abs(hit.distance - s.distance) > 1e-3f * s.distance) continue;
                    const SurfacePoint point = make_surface_point(stage.shading, hit, s.direction);
                    const float cosine = -glm::dot(point.geometric, s.direction);
                    const float pdf = pdf_emitter(emitter, receiver.position, hit, cosine, hit.distance);
                    others += std::abs(pdf / s.pdf - 1.0f) > 0.01f;  // rounding at the border of a cell
                    ++compared;
                }
            }
            EXPECT_GT(compared, 1000);
            EXPECT_LE(others, compared / 200);
        }
    }
}

TEST(EmissionCells, StrengthIsTheMeanOfCells) {
    for (const bool nearest : {false, true}) {
        const Stage stage(make_spotted_lamp(nearest));
        const double expected = spot_radiance * 4.0 * static_cast<double>(spots.size()) / (texels * texels);
        EXPECT_NEAR(stage.lights.bounds.strength[0], expected, 0.03 * expected);
    }
    // A texture that shines evenly needs no cells, and counts as all bright.
    Scene even = make_spotted_lamp(true);
    for (glm::vec4& texel : even.images[0].floats.pixels) texel = glm::vec4(0.5f);
    const Stage stage(std::move(even));
    EXPECT_TRUE(stage.lights.emitters[0].shape->cells.empty());
    EXPECT_NEAR(stage.lights.bounds.strength[0], spot_radiance * 4.0f, 1e-3f);
}

/// A lamp that shines through the holes that a mask leaves, which are a share of its texels.
Scene make_masked_lamp(double share) {
    Scene scene = make_spotted_lamp(true);
    std::mt19937 generator(5);
    std::bernoulli_distribution shows(share);
    for (glm::vec4& texel : scene.images[0].floats.pixels) texel.w = shows(generator) ? 1.0f : 0.0f;
    scene.materials[0].textures[TextureSlot::base_color] = scene.materials[0].textures[TextureSlot::emission];
    scene.materials[0].textures[TextureSlot::emission] = {};
    scene.materials[0].opacity = {.mode = Opacity::Mode::mask, .cutoff = 0.5};
    return scene;
}

TEST(EmissionCells, MasksFinerThanAFootprintLeaveTheirShare) {
    for (const double share : {0.2, 0.3, 0.7, 0.8}) {
        const Stage stage(make_masked_lamp(share));
        const Receiver receiver{glm::vec3(0.0f, -20.0f, 3.0f) - glm::vec3(stage.shading.anchor), up};
        RandomStream random({24, 0, 0, 0});
        Mean points, parts;
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec2 u = random.next_2d();
            points.add(sample_light(stage.shading, stage.lights, 0, receiver, u).incoming.x);
            parts.add(sample_light(stage.shading, stage.lights, 0, receiver, u, 0.25f).incoming.x);
        }
        EXPECT_NEAR(parts.mean(), points.mean(), 0.05 * points.mean()) << share;
    }
}

TEST(EmissionCells, PartsThatAMaskLeavesOutAreNotSampled) {
    Scene scene = make_spotted_lamp(true);
    scene.materials[0].textures[TextureSlot::emission] = {};
    for (glm::vec4& texel : scene.images[0].floats.pixels) texel = glm::vec4(1.0f, 1.0f, 1.0f, texel.x);
    scene.materials[0].textures[TextureSlot::base_color] = {.image = 0, .nearest = true};
    scene.materials[0].opacity = {.mode = Opacity::Mode::mask, .cutoff = 0.5};
    const Stage stage(std::move(scene));
    const glm::vec3 place = near_and_far[2];
    const Receiver receiver{place - glm::vec3(stage.shading.anchor), up};
    EXPECT_TRUE(holds([&](Trial& trial) {
        RandomStream random({23 + trial.seed, 0, 0, 0});
        Mean light, found;
        for (int i = 0; i < trial.times(20'000); ++i) {
            const LightSample s = sample_light(stage.shading, stage.lights, 0, receiver, random.next_2d());
            light.add(s.incoming.x);
            found.add(s.incoming.x > 0.0f ? 1.0 : 0.0);
        }
        trial.near(light, spot_radiance * spots_angle(place));
        EXPECT_GT(found.mean(), 0.8);
    }));
}

/// Alpha of the corners grows from a half along the lamp, and a quarter of it shows.
TEST(EmissionCells, CornersHideTheirPart) {
    Scene scene = make_masked_lamp(1.0);
    const Mesh quad = make_quad(2.0, 2.0, 0);
    for (const glm::vec2& uv : quad.uv[0]) scene.meshes[0].colors.emplace_back(1.0f, 1.0f, 1.0f, 0.5f + 0.5f * uv.x);
    scene.materials[0].opacity.cutoff = 0.875;
    const Stage stage(std::move(scene));
    ASSERT_FALSE(stage.lights.emitters[0].shape->cells.empty());
    EXPECT_NEAR(stage.lights.bounds.strength[0], 0.25 * spot_radiance * 4.0, 0.01 * spot_radiance);
}

}  // namespace
}  // namespace aleph
