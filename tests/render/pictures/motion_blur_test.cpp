// Pictures while the shutter is open, against the exact shape at 4096 times.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 24, height = 16, spp = 16;
constexpr double frames_per_second = 30.0;
constexpr double pixels_per_metre = 4.0;  // the picture is 6 m by 4 m, parallel rays

RenderSettings blur_settings(std::uint32_t seed) {
    RenderSettings settings = path_settings(0, spp, seed);
    set_size(settings, width, height);
    settings.picture.filter = PixelFilter::box;
    return settings;
}

/// A square of radiance .25 before black, seen along parallel rays. Node 0 is the square.
Scene make_square_scene(const glm::dvec2& shutter) {
    Scene scene;
    add_mesh(scene, make_quad(2.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.25), true)));
    add_flat_view(scene, 0.5 * height / pixels_per_metre, shutter);
    return scene;
}

/// Times of frames, s.
double at(double frame) {
    return frame / frames_per_second;
}

/// Returns whether the square covers a point of the picture (m, from its middle) at a time in frames.
using Shape2d = std::function<bool(glm::dvec2 point, double frame)>;

bool is_in_square(const glm::dvec2& p) {
    return std::abs(p.x) < 1.0 && std::abs(p.y) < 0.5;
}

/// Renders frame 0 with many seeds. The truth is the mean over 4096 times and places in the pixel.
void expect_coverage(const Scene& scene, const Shape2d& covers) {
    const glm::dvec2 shutter = scene.cameras[0].shutter;
    constexpr std::uint32_t seeds = 16;
    constexpr int times = 4096;
    EXPECT_TRUE(holds([&](Trial& trial) {
        std::vector<Mean> coverage(width * height), red(width * height);
        Mean all;
        for (std::uint32_t run = 0; run < trial.times(seeds); ++run) {
            Sequence sequence(scene, blur_settings(run + trial.seed));
            const FrameOutput out = sequence.render(0);
            double sum = 0.0;
            for (std::size_t i = 0; i < coverage.size(); ++i) {
                coverage[i].add(out.shaded.coverage.pixels[i]);
                red[i].add(out.shaded.color.pixels[i].x);
                sum += out.shaded.coverage.pixels[i];
            }
            all.add(sum);
        }
        int beyond = 0;
        double truth_sum = 0.0;
        for (std::size_t i = 0; i < coverage.size(); ++i) {
            const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
            int inside = 0;
            for (int t = 0; t < times; ++t) {
                const glm::vec2 offset = lattice_point(t, times, {0.0f, 0.5f});
                const glm::dvec2 point((x + offset.x - 0.5 * width) / pixels_per_metre,
                                       (0.5 * height - y - offset.y) / pixels_per_metre);
                const double time = std::fmod((t + 0.5) * 0.41421356237309505, 1.0);
                if (covers(point, shutter.x + (shutter.y - shutter.x) * time)) ++inside;
            }
            const double truth = static_cast<double>(inside) / times;
            const double variance = truth * (1.0 - truth) / spp;  // of independent samples
            truth_sum += truth;
            const Mean& found = coverage[i];
            // Where few seeds met the square, their spread says little.
            const double tolerance = 3.0 * std::max(found.error(), std::sqrt(variance / trial.times(seeds))) + 1e-3;
            if (std::abs(found.mean() - truth) > tolerance) ++beyond;
            EXPECT_NEAR(found.mean(), truth, 2.0 * tolerance) << x << " " << y;
            EXPECT_NEAR(red[i].mean(), 0.25 * found.mean(), 1e-5);  // too dark for bright_edges.h
        }
        trial.at_most(beyond, 0.0, width * height / 100);
        trial.near(all, truth_sum, 2e-3 * truth_sum);
        EXPECT_GT(truth_sum, 5.0);
    }));
}

TEST(MotionBlur, MC27_AMovingSquareCoversItsShareOfTheTime) {
    Scene scene = make_square_scene({0.0, 2.0});
    scene.nodes[0].transform.translation = Track<glm::dvec3>({0.0, at(2)}, {{-1.5, 0.0, 0.0}, {1.5, 0.5, 0.0}});
    expect_coverage(scene, [](glm::dvec2 p, double frame) {
        return is_in_square(p - glm::dvec2(-1.5 + 1.5 * frame, 0.25 * frame));
    });
}

TEST(MotionBlur, MC27_FewSamplesShowNoCopies) {
    // A tall bar that moves by 12 pixels, with 4 samples a pixel: blocks of 2x2 pixels see 16 times.
    Scene scene = make_square_scene({0.0, 1.0});
    scene.nodes[0].transform.scale = glm::dvec3(0.25, 8.0, 1.0);
    scene.nodes[0].transform.translation = Track<glm::dvec3>({0.0, at(1)}, {{-1.5, 0.0, 0.0}, {1.5, 0.0, 0.0}});
    double squares = 0.0;
    int blocks = 0;
    for (std::uint32_t seed = 0; seed < 16; ++seed) {
        RenderSettings settings = blur_settings(seed);
        settings.sampling.spp = 4;
        const Image<float> coverage = Sequence(scene, settings).render(0).shaded.coverage;
        for (int x = 8; x < 16; x += 2) {  // where the bar passes wholly: 2 of 12 pixels wide
            for (int y = 0; y < height; y += 2) {
                const float sum = coverage(x, y) + coverage(x + 1, y) + coverage(x, y + 1) + coverage(x + 1, y + 1);
                squares += std::pow(0.25 * sum - 2.0 / 12.0, 2.0);
                ++blocks;
            }
        }
    }
    EXPECT_LT(std::sqrt(squares / blocks), 0.4 * 2.0 / 12.0);  // with the same times in all pixels: 0.58
}

TEST(MotionBlur, MC27_TurnsFollowTheArc) {
    for (const double degrees : {0.0, 179.0, 540.0}) {
        SCOPED_TRACE(degrees);
        const double turn = degrees * std::numbers::pi / 180.0;
        Scene scene = make_square_scene({-0.5, 0.5});
        scene.nodes[0].transform.axis_rotation =
            AxisRotation{{0.0, 0.0, 1.0}, Track<double>({at(-0.5), at(0.5)}, {0.2, 0.2 + turn})};
        expect_coverage(scene, [&](glm::dvec2 p, double frame) {
            const double angle = 0.2 + turn * (frame + 0.5), c = std::cos(angle), s = std::sin(angle);
            return is_in_square({c * p.x + s * p.y, c * p.y - s * p.x});
        });
    }
}

TEST(MotionBlur, MC27_AScaleThroughZero) {
    Scene scene = make_square_scene({0.0, 1.0});
    scene.nodes[0].transform.scale = Track<glm::dvec3>({0.0, at(1)}, {{1.5, 1.0, 1.0}, {-1.5, 1.0, 1.0}});
    expect_coverage(scene, [](glm::dvec2 p, double frame) { return is_in_square({p.x / (1.5 - 3.0 * frame), p.y}); });
}

TEST(MotionBlur, MC27_AVisibilitySwitch) {
    Scene scene = make_square_scene({0.0, 1.0});
    scene.nodes[0].visible = Track<double>({0.0, at(0.7)}, {0.0, 1.0}, Interpolation::step);
    expect_coverage(scene, [](glm::dvec2 p, double frame) { return frame >= 0.7 && is_in_square(p); });
}

TEST(MotionBlur, MC27_AShutterOfTenFrames) {
    Scene scene = make_square_scene({-5.0, 5.0});
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({at(-5), at(0), at(5)}, {{-2, -1, 0}, {0, 1, 0}, {2, -1, 0}});
    expect_coverage(scene, [](glm::dvec2 p, double frame) {
        return is_in_square(p - glm::dvec2(0.4 * frame, 1.0 - 0.4 * std::abs(frame)));
    });
}

TEST(MotionBlur, MC27_AShutterOfZeroLengthIsOneMoment) {
    // Moving or not: [x, x] is the still picture of that time, and [0, 0] the frame's own.
    const auto render = [](double offset, bool moves, double place) {
        Scene scene = make_square_scene(glm::dvec2(offset));
        scene.nodes[0].transform.translation = glm::dvec3(place, 0.0, 0.0);
        if (moves)
            scene.nodes[0].transform.translation = Track<glm::dvec3>({0.0, at(2)}, {glm::dvec3(0.0), {3.0, 0.0, 0.0}});
        return Sequence(scene, blur_settings(1)).render(0);
    };
    for (const double offset : {0.0, 0.5, 1.7}) {
        const FrameOutput moment = render(offset, true, 0.0), still = render(0.0, false, 1.5 * offset);
        EXPECT_EQ(moment.shaded.coverage, still.shaded.coverage) << offset;
        EXPECT_EQ(moment.shaded.color, still.shaded.color) << offset;
    }
}

TEST(MotionBlur, MC27_NoGhostOfTheOtherShot) {
    // The camera jumps at frame 5 from a green square to a red one.
    const auto render = [](std::int64_t frame, const glm::dvec2& shutter) {
        Scene scene = make_square_scene(shutter);
        scene.film.cuts = {5};
        scene.materials[0].glow.color = glm::dvec3(0.0, 1.0, 0.0);
        add_mesh(scene, make_quad(2.0, 1.0, add_lambert(scene, glm::dvec3(0.0), {1.0, 0.0, 0.0})), {50.0, 0.0, 0.0});
        scene.nodes[1].transform.translation =
            Track<glm::dvec3>({0.0, at(5)}, {{0.0, 0.0, 5.0}, {50.0, 0.0, 5.0}}, Interpolation::step);
        const FrameOutput out = Sequence(scene, blur_settings(1)).render(frame);
        glm::dvec3 sum(0.0);
        for (const Rgb& pixel : out.shaded.color.pixels) sum += glm::dvec3(pixel);
        return sum;
    };
    for (const glm::dvec2& shutter : {glm::dvec2(-0.5, 0.5), glm::dvec2(-9.0, 9.0), glm::dvec2(1.0, 1.5),
                                      glm::dvec2(2.0, 2.0), glm::dvec2(-3.0, -2.0)}) {
        const glm::dvec3 before = render(4, shutter), after = render(5, shutter);
        EXPECT_EQ(before.x, 0.0) << shutter.x;
        EXPECT_NEAR(before.y, 32.0, 1e-3);
        EXPECT_EQ(after.y, 0.0) << shutter.x;
        EXPECT_NEAR(after.x, 32.0, 1e-3);
    }
}

TEST(MotionBlur, FX15_LightThatChangesWhereNothingInViewMoves) {
    // A white floor under a lamp. Behind the camera a door opens at a quarter of the shutter, or the lamp fades in.
    for (const bool door : {false, true}) {
        Scene scene;
        scene.film.exposure = 1.0;
        scene.film.range = FrameRange{0, 10};
        add_mesh(scene, make_quad(50.0, 50.0, add_lambert(scene, glm::dvec3(1.0), glm::dvec3(0.0), true)));
        add_light(scene, Light::Kind::directional, glm::dvec3(std::numbers::pi), {0.0, 0.0, 20.0});
        add_camera(scene, {0.0, 0.0, 5.0}, glm::dvec3(0.0));
        scene.cameras[0].shutter = {0.0, 1.0};
        if (door) {
            const int node = add_mesh(scene, make_quad(100.0, 100.0, 0), {0.0, 0.0, 10.0});
            scene.nodes[node].visible = Track<double>({0.0, at(0.25)}, {1.0, 0.0}, Interpolation::step);
        } else {
            scene.lights[0].intensity = Track<double>({0.0, at(1)}, {0.0, 1.5});
        }
        EXPECT_TRUE(holds([&](Trial& trial) {
            Mean mean;
            for (std::uint32_t run = 0; run < trial.times(16u); ++run) {
                mean.add(Sequence(scene, blur_settings(run + trial.seed)).render(0).shaded.color(12, 8).x);
            }
            trial.near(mean, 0.75, 1e-4);
            EXPECT_LT(mean.error(), 0.02);
        }));
    }
}

/// A wall, and a lamp that shines in the last quarter of the shutter.
Scene make_late_lamp(double albedo) {
    Scene scene;
    scene.film.exposure = 1.0;
    scene.film.range = FrameRange{0, 10};
    add_mesh(scene, make_quad(50.0, 50.0, add_lambert(scene, glm::dvec3(albedo), glm::dvec3(0.0), true)));
    const int shining = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0), true);
    scene.materials[shining].glow.strength = Track<double>({0.0, at(0.75)}, {0.0, 100.0}, Interpolation::step);
    add_mesh(scene, make_quad(1.0, 1.0, shining), {4.0, 0.0, 6.0});
    add_camera(scene, {0.0, 0.0, 5.0}, glm::dvec3(0.0));
    scene.cameras[0].shutter = {0.0, 1.0};
    return scene;
}

TEST(MotionBlur, FX15_ALampThatIsDarkAtTheShuttersCentreCastsShadows) {
    // A plate keeps the lamp's light from the floor at the origin.
    Scene scene = make_late_lamp(1.0);
    const int plate = add_mesh(scene, make_quad(2.0, 2.0, 0), {2.0, 0.0, 3.0});
    RenderSettings settings = blur_settings(0);
    const Image<Rgb> planned = Sequence(scene, settings).render(0).shaded.color;
    settings.effects.plan = EffectsPlanning::off;
    const Image<Rgb> all = Sequence(scene, settings).render(0).shaded.color;
    EXPECT_EQ(planned.pixels, all.pixels);
    scene.nodes[plate].visible = false;
    const Image<Rgb> open = Sequence(scene, settings).render(0).shaded.color;
    EXPECT_LT(all(width / 2, height / 2).x, 0.5f * open(width / 2, height / 2).x);
    EXPECT_GT(open(width / 2, height / 2).x, 0.01f);
}

/// Rays of a record are not those of a sample that has none.
TEST(MotionBlur, SamplesWithoutARecordDoNotCastTheRaysOfOne) {
    Scene scene = make_late_lamp(0.5);
    // It spins so fast that its light is known at no other time.
    scene.nodes[1].transform.axis_rotation =
        AxisRotation{.axis = {0.0, 1.0, 0.0}, .angle = Track<double>({0.0, at(1.0)}, {0.0, 60.0})};
    std::vector<std::uint64_t> rays;
    for (const int gather : {4, 256}) {
        RenderSettings settings = blur_settings(1);
        settings.light.integrator = Integrator::cache;
        settings.light.bounces = 1;
        settings.cache.accuracy = 0.3;
        settings.cache.light_step = 0;
        settings.cache.gather = gather;
        settings.effects.plan = EffectsPlanning::off;
        rays.push_back(Sequence(scene, settings).render(0).statistics.counts.rays.path);
    }
    EXPECT_GT(rays[0], 0u);
    EXPECT_EQ(rays[0], rays[1]);
}

TEST(MotionBlur, MC27_AChangeOfTopologyShowsBothMeshes) {
    // A surface of one triangle in frame 0, of two in frame 1.
    Scene scene = load_scene(source_folder() / "scenes" / "hard" / "changing_topology.json");
    scene.environment.radiance.reset();
    EXPECT_TRUE(holds([&](Trial& trial) {
        std::vector<Mean> blurred(width * height), still(width * height);
        for (std::uint32_t seed = trial.seed; seed < trial.seed + trial.times(16u); ++seed) {
            scene.cameras[0].shutter = {0.0, 0.0};
            Sequence frames(scene, blur_settings(seed));
            const Image<Rgb> first = frames.render(0).shaded.color, second = frames.render(1).shaded.color;
            scene.cameras[0].shutter = {0.0, 2.0};
            const Image<Rgb> both = Sequence(scene, blur_settings(seed + 100)).render(0).shaded.color;
            for (std::size_t i = 0; i < blurred.size(); ++i) {
                blurred[i].add(luminance(both.pixels[i]));
                still[i].add(0.5 * (luminance(first.pixels[i]) + luminance(second.pixels[i])));
            }
        }
        int beyond = 0;
        Mean difference;
        for (std::size_t i = 0; i < blurred.size(); ++i) {
            const double error = std::hypot(blurred[i].error(), still[i].error());
            if (std::abs(blurred[i].mean() - still[i].mean()) > 3.0 * error + 1e-5) ++beyond;
            difference.add(blurred[i].mean() - still[i].mean());
        }
        trial.at_most(beyond, 0.0, width * height / 50);  // 0.9 % of Student's t of 15 degrees of freedom are
        trial.near(difference, 0.0);
    }));
}

}  // namespace
}  // namespace aleph
