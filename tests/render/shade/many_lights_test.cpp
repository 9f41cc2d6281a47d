// Frames under ten lights and under a thousand, at an error that is asked for: what they cost, and what they err by.

#include "render/frame/sequence.h"
#include "render/light/known_lights.h"
#include "render/light/light_cut.h"
#include "tests/support/all_pixels.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

enum class CrowdKind { equal, one_bright, one_visible, one_visible_open, coincident, moving, veiled };

/// With a closed shutter and with an open one.
bool shows_one(CrowdKind kind) {
    return kind == CrowdKind::one_visible || kind == CrowdKind::one_visible_open;
}

constexpr int crowd_width = 24, crowd_height = 16;
constexpr double crowd_pixel = 0.05, crowd_fps = 30.0;  // m; frames per second

struct CrowdLight {
    glm::dvec3 at, to;  ///< m, at frame 0 and at frame 10
    double intensity = 1.0;
    bool seen = true;
};

/// Lights two metres above a floor, all of them with 2 cd together that reach it.
std::vector<CrowdLight> place_crowd(int count, CrowdKind kind) {
    std::vector<CrowdLight> lights;
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    double total = 0.0;
    for (int i = 0; i < count; ++i) {
        CrowdLight light;
        light.at = {4.0 * (i % side + 0.5) / side - 2.0, 2.0 + 0.3 * std::sin(1.7 * i),
                    4.0 * (i / side + 0.5) / side - 2.0};
        if (kind == CrowdKind::coincident) light.at = {0.5, 2.0, 0.5};
        if (kind == CrowdKind::one_bright && i == count * 6 / 10) light.intensity = 1e6;
        light.seen = !shows_one(kind) || i == count / 3;
        if (shows_one(kind) && light.seen) light.at = {0.3, 1.0, 0.2};
        light.to = light.at;
        if (kind == CrowdKind::moving) light.to.x += i % 2 == 0 ? 0.8 : -0.8;
        if (light.seen) total += light.intensity;
        lights.push_back(light);
    }
    for (CrowdLight& light : lights) light.intensity *= 2.0 / total;
    return lights;
}

constexpr double veil_alpha = 0.5;

/// The floor from straight above. A sheet hides all lights above 1.4 m where but one are to be hidden; another, above
/// the camera, takes half of the light of those that are veiled.
Scene make_crowd_scene(const std::vector<CrowdLight>& lights, CrowdKind kind) {
    Scene scene;
    scene.film.exposure = 1.0;
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.6))), glm::dvec3(0.0), z_to_up);
    if (shows_one(kind)) {
        const int black = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
        add_mesh(scene, make_quad(20.0, 20.0, black), {0.0, 1.4, 0.0}, z_to_up);
    }
    if (kind == CrowdKind::veiled) {
        const int veil = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
        scene.materials[veil].opacity = {.alpha = veil_alpha, .mode = Opacity::Mode::blend};
        add_mesh(scene, make_quad(20.0, 20.0, veil), {0.0, 0.95, 0.0}, z_to_up);
    }
    add_camera(scene, {0.0, 0.9, 0.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    if (kind == CrowdKind::one_visible_open) {
        scene.cameras[0].shutter = {0.0, 0.5};
        const int patch = add_mesh(scene, make_quad(0.3, 0.3, 0), {}, z_to_up);  // of the floor
        scene.nodes[patch].transform.translation =
            Track<glm::dvec3>({0.0, 10.0 / crowd_fps}, {{-0.2, 5e-4, 0.0}, {0.2, 5e-4, 0.0}});
    }
    scene.cameras[0].half_height = 0.5 * crowd_height * crowd_pixel;
    for (const CrowdLight& light : lights) {
        add_light(scene, Light::Kind::point, glm::dvec3(light.intensity), light.at);
        if (kind == CrowdKind::moving)
            scene.nodes.back().transform.translation = Track<glm::dvec3>({0.0, 10.0 / crowd_fps}, {light.at, light.to});
    }
    return scene;
}

/// @param moved  share of the way
double crowd_radiance(const std::vector<CrowdLight>& lights, const glm::dvec3& point, double moved) {
    double sum = 0.0;
    for (const CrowdLight& light : lights) {
        if (!light.seen) continue;
        const glm::dvec3 way = glm::mix(light.at, light.to, moved) - point;
        const double square = glm::dot(way, way);
        sum += 0.6 / pi * light.intensity * way.y / (square * std::sqrt(square));
    }
    return sum;
}

struct CrowdCost {
    double samples = 0.0;  ///< of a pixel
    int beyond = 0;        ///< pixels that err by more than a threshold
};

CrowdCost render_crowd(int count, CrowdKind kind) {
    const std::vector<CrowdLight> lights = place_crowd(count, kind);
    const Scene scene = make_crowd_scene(lights, kind);
    const bool moves = kind == CrowdKind::moving || kind == CrowdKind::one_visible_open;
    RenderSettings settings{.picture = {.width = crowd_width, .height = crowd_height, .filter = PixelFilter::box}};
    settings.cache.light_step = 0;
    settings.light.bounces = 0;
    follow_error(settings, 1.0);
    CrowdCost cost;
    constexpr std::uint32_t seeds = 6;
    for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
        const FrameOutput out = Sequence(scene, settings).render(moves ? 5 : 0);
        for (const auto [x, y] : all_pixels(crowd_width, crowd_height)) {
            double truth = 0.0;
            for (int p = 0; p < 16; ++p) {
                const glm::dvec3 point((x + (p % 4 + 0.5) / 4 - 0.5 * crowd_width) * crowd_pixel, 0.0,
                                       (y + (p / 4 + 0.5) / 4 - 0.5 * crowd_height) * crowd_pixel);
                truth += crowd_radiance(lights, point, moves ? 0.5 : 0.0) / 16.0;
            }
            if (kind == CrowdKind::veiled) truth *= 1.0 - veil_alpha;
            const double error = std::abs(luminance(out.shaded.color(x, y)) - truth);
            cost.beyond += error * scene.film.viewing.display_white > out.limits.threshold(x, y);
            cost.samples += out.shaded.samples(x, y) / (seeds * crowd_width * crowd_height);
        }
    }
    return cost;
}

TEST(ManyLights, MC23_AThousandCostAtMostFourTimesTenAndNoPixelErrsByMore) {
    for (const CrowdKind kind :
         {CrowdKind::equal, CrowdKind::one_bright, CrowdKind::one_visible, CrowdKind::one_visible_open,
          CrowdKind::coincident, CrowdKind::moving, CrowdKind::veiled}) {
        SCOPED_TRACE(static_cast<int>(kind));
        const CrowdCost ten = render_crowd(10, kind), thousand = render_crowd(1000, kind);
        EXPECT_EQ(ten.beyond, 0);
        EXPECT_EQ(thousand.beyond, 0);
        EXPECT_LE(thousand.samples, 4.0 * ten.samples);
    }
}

/// Light at the middle of the floor by so many samples, which choose lights by a tree.
Mean sample_floor(const Stage& stage, const SplitLights& split, int count, std::uint32_t seed, int lights) {
    LightingContext lighting = stage.lighting();
    lighting.seen = &split;
    const ViewedSurface floor{make_point(glm::vec3(0.0f), up), make_lambert(0.6f), up};
    RayTask task(stage.rays);
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const PixelSequence sequence(static_cast<std::uint32_t>(i) + seed, 0, 5, 7);
        mean.add(sample_direct_light(lighting, task, LitSurface(floor), {}, sequence, {0, lights}).x);
    }
    return mean;
}

TEST(ManyLights, MC23_HiddenLightsAreChosenSeldom) {
    const std::vector<CrowdLight> lights = place_crowd(1000, CrowdKind::one_visible);
    const Stage stage(make_crowd_scene(lights, CrowdKind::one_visible), 32, 24);
    RayCounts counts;
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    const KnownLights known = find_known_lights(stage.lighting(), stage.view, centers, counts);
    const SplitLights split = KnownLightTrees(stage.shading, stage.lights, known).seen;
    ASSERT_FALSE(split.others.groups.empty());
    EXPECT_LE(counts.shadow, 2u * 64'000u + 64u);
    const double expected = crowd_radiance(lights, glm::dvec3(0.0), 0.0);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean mean = sample_floor(stage, split, trial.times(2000), trial.seed, 1);
        trial.near(mean, expected, 1e-5 * expected);
        EXPECT_LT(mean.error() * std::sqrt(trial.times(2000.0)), 1e-3 * expected);  // by power alone 30 times expected
    }));
}

/// Choices that are wrong about every other light, which is seen, have the right mean.
TEST(ManyLights, MC23_LightsThatAreTakenForHiddenKeepTheirLight) {
    const std::vector<CrowdLight> lights = place_crowd(1000, CrowdKind::equal);
    const Stage stage(make_crowd_scene(lights, CrowdKind::equal), 32, 24);
    const auto make_tree_without = [&](std::size_t first) {
        std::vector<LightNode> nodes = make_light_nodes(stage.shading, stage.lights);
        for (std::size_t i = first; i < nodes.size(); i += 2) nodes[i].strength = nodes[i].most = 0.0f;
        return make_light_tree(nodes);
    };
    const SplitLights split{make_tree_without(0), make_tree_without(1), 0.25f};
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean mean = sample_floor(stage, split, trial.times(4000), trial.seed, 4);
        trial.near(mean, crowd_radiance(lights, glm::dvec3(0.0), 0.0), 1e-5);
    }));
    // Where nothing is hidden, the choice stays as it is.
    RayCounts counts;
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    EXPECT_TRUE(find_known_lights(stage.lighting(), stage.view, centers, counts).unseen.empty());
}

}  // namespace
}  // namespace aleph
