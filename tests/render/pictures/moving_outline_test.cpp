// Outlines of fast things before a detailed wall at rest: samples there show both, so the wall's threshold holds.

#include "render/frame/sequence.h"
#include "tests/support/keyed_track.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int outline_width = 36, outline_height = 24;
constexpr double outline_pixel = 0.125;  // m

/// Bars of a few pixels that shine, and a plate 1.5 m wide before them that moves by 12 pixels a frame.
Scene make_wall(bool plate) {
    Scene scene;
    const int bright = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.30)),
              dark = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.22)),
              moving = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.38));
    for (int i = 0; i < 24; ++i) {
        add_mesh(scene, make_quad(0.3, 8.0, i % 2 == 0 ? bright : dark), {0.3 * i - 3.45, 0.0, 0.0});
    }
    if (plate) {
        const int node = add_mesh(scene, make_quad(1.5, 2.2, moving));
        scene.nodes[node].transform.translation =
            keyed<glm::dvec3>({0.0, 10.0 / 30.0}, {{-1.2, 0.1, 1.0}, {13.8, 0.1, 1.0}});
    }
    add_flat_view(scene, 0.5 * outline_height * outline_pixel);
    return scene;
}

RenderSettings outline_settings(PixelFilter filter) {
    RenderSettings settings;
    settings.picture.width = outline_width;
    settings.picture.height = outline_height;
    settings.picture.filter = filter;
    settings.cache.light_step = 0;
    settings.light.bounces = 0;
    return settings;
}

struct MovingOutline : testing::TestWithParam<PixelFilter> {};
INSTANTIATE_TEST_SUITE_P(Filters, MovingOutline, testing::Values(PixelFilter::box, PixelFilter::blackman_harris));

TEST_P(MovingOutline, MC27_IsWithinTheThresholdOfTheWall) {
    constexpr std::int64_t frame = 1;
    RenderSettings settings = outline_settings(GetParam());
    settings.sampling.spp = 256;
    settings.perception.guide = Guide::none;
    const Image<Rgb> reference = Sequence(make_wall(true), settings).render(frame).shaded.color;
    int beyond = 0, outline = 0;
    float least = 1e30f, most = 0.0f;
    for (std::uint32_t seed = 0; seed < 2; ++seed) {
        settings = outline_settings(GetParam());
        follow_error(settings, 1.0);
        settings.seed = seed;
        const FrameOutput wall =
            Sequence(make_wall(false), settings).render(frame, {.frame = false, .maps = true, .progress = {}});
        const FrameOutput out = Sequence(make_wall(true), settings).render(frame);
        for (int y = 1; y < outline_height - 1; ++y) {
            for (int x = 1; x < outline_width - 1; ++x) {
                const auto moves = [&](int i, int j) { return out.hits(i, j).instance == 24; };
                const int near = moves(x - 1, y) + moves(x + 1, y) + moves(x, y - 1) + moves(x, y + 1) + moves(x, y);
                if (near == 0 || near == 5) continue;
                ++outline;
                const float error = std::abs(luminance(out.shaded.color(x, y)) - luminance(reference(x, y))) *
                                    static_cast<float>(make_wall(true).film.viewing.display_white);
                if (error > wall.limits.threshold(x, y)) ++beyond;
                const float ratio = out.limits.threshold(x, y) / wall.limits.threshold(x, y);
                least = std::min(least, ratio);
                most = std::max(most, ratio);
            }
        }
    }
    ASSERT_GT(outline, 130);
    EXPECT_GT(most, 2.0f * least);  // the plate's own threshold is far looser
    EXPECT_LE(beyond, outline / 200) << outline;
}

}  // namespace
}  // namespace aleph
