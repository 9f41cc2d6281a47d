// Tracks along known motion.

#include "render/compare/surface_track.h"
#include "tests/support/test.h"

namespace aleph::surface_track_test {
namespace {

constexpr int width = 40, height = 30;

MotionMaps uniform(float u, float v, float object = 1.0f) {
    return {Image<float>(width, height, u), Image<float>(width, height, v), Image<float>(width, height, 1.0f),
            Image<float>(width, height, object)};
}

TEST(SurfaceTrack, UniformMotionAddsUp) {
    const MotionMaps maps = uniform(1.25f, 0.5f);
    const std::vector<const MotionMaps*> motion(7, &maps);
    const auto [after, before] = track_surfaces(motion, 3);
    ASSERT_EQ(after.size(), 3u);
    ASSERT_EQ(before.size(), 3u);
    for (int k = 1; k <= 3; ++k) {
        const glm::vec2 next = after[static_cast<std::size_t>(k - 1)](12, 13);
        EXPECT_FLOAT_EQ(next.x, 12.0f + 1.25f * static_cast<float>(k));
        EXPECT_FLOAT_EQ(next.y, 13.0f - 0.5f * static_cast<float>(k)) << "v points upwards";
        const glm::vec2 last = before[static_cast<std::size_t>(k - 1)](12, 13);
        EXPECT_FLOAT_EQ(last.x, 12.0f - 1.25f * static_cast<float>(k));
        EXPECT_FLOAT_EQ(last.y, 13.0f + 0.5f * static_cast<float>(k));
    }
    EXPECT_TRUE(std::isnan(after[2](width - 1, 10).x)) << "leaves the picture";
    EXPECT_TRUE(std::isnan(before[2](0, 10).x)) << "was not in the picture";
}

TEST(SurfaceTrack, ZoomAndItsInverseMeet) {
    MotionMaps zoom = uniform(0.0f, 0.0f);
    for (const auto [x, y] : all_pixels(width, height)) {
        zoom.u(x, y) = 0.1f * static_cast<float>(x - 20);
        zoom.v(x, y) = -0.1f * static_cast<float>(y - 15);
    }
    const std::vector<const MotionMaps*> motion(2, &zoom);
    const glm::vec2 source = track_surfaces(motion, 1).before[0](31, 4);
    EXPECT_NEAR(source.x, 20.0f + 11.0f / 1.1f, 2e-3f);
    EXPECT_NEAR(source.y, 15.0f - 11.0f / 1.1f, 2e-3f);
}

TEST(SurfaceTrack, EndsWhereSomethingElseIsInFront) {
    MotionMaps now = uniform(2.0f, 0.0f), next = uniform(2.0f, 0.0f);
    next.object(14, 10) = 2.0f;
    const std::vector<const MotionMaps*> motion{&now, &next};
    const TrackImage after = track_surfaces(motion, 0).after.at(0);
    EXPECT_TRUE(std::isnan(after(12, 10).x));
    EXPECT_FALSE(std::isnan(after(13, 10).x));
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 1).before.at(0)(14, 10).x)) << "the object in front was not there";
}

TEST(SurfaceTrack, InvalidMotionLeadsNowhere) {
    MotionMaps maps = uniform(1.0f, 0.0f);
    maps.valid(5, 5) = -4.0f;
    const std::vector<const MotionMaps*> motion(2, &maps);
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 0).after.at(0)(5, 5).x));
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 1).before.at(0)(6, 5).x));
}

TEST(SurfaceTrack, MapsWithoutMotionAreAtRest) {
    const MotionMaps maps = read_motion({{{"threshold.Y", Image<float>(3, 2, 1.0f)}}, {}});
    EXPECT_EQ(maps.u.width, 3);
    EXPECT_EQ(maps.v.height, 2);
    EXPECT_EQ(maps.valid(2, 1), 1.0f);
}

}  // namespace
}  // namespace aleph::surface_track_test
