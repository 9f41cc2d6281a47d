// Surfaces of the picture and those that rays from them meet, and bounds of caches, by hand.

#include "render/cache/bounce_places.h"
#include "render/cache/further_bounces.h"
#include "render/cache/gather_at.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct LeftHalfKnown : CarriedLight {
    int half = 0;
    std::optional<Rgb> find(const PixelSurface& surface, float, RayTask&, RecordUse*) const override {
        return surface.x < half ? std::optional<Rgb>(Rgb(1.0f)) : std::nullopt;
    }
};

/// A Lambert floor at y = 0 under a ceiling at y = 2, seen from above the floor, straight down: it fills the picture.
struct Rooms : IndirectStage {
    static Scene make_scene() {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
        add_mesh(scene, make_quad(400.0, 400.0, white), glm::dvec3(0.0), z_to_up);
        add_mesh(scene, make_quad(4000.0, 4000.0, white), {0.0, 2.0, 0.0}, z_to_down);
        add_camera(scene, {0.0, 1.0, 0.0}, glm::dvec3(0.0));
        return scene;
    }

    Rooms(int width, int height) : IndirectStage(make_scene(), width, height, 0.25) { context.max_radius = 3.0f; }

    std::vector<PixelSurface> seen() {
        std::vector<PixelSurface> surfaces;
        add_seen_surfaces(context, centers, surfaces, counts);
        return surfaces;
    }

    RayCounts counts;
};

TEST(BouncePlaces, SeenSurfacesAreOneInEachTile) {
    // 312 x 208 pixels in 2,000 tiles: 6 wide.
    Rooms rooms(312, 208);
    std::vector<PixelSurface> surfaces = rooms.seen();
    ASSERT_EQ(surfaces.size(), 52u * 35u);
    for (int i = 0; i < 1820; ++i) {
        EXPECT_EQ(surfaces[static_cast<std::size_t>(i)].x, i % 52 * 6 + 1);
        EXPECT_EQ(surfaces[static_cast<std::size_t>(i)].y, i / 52 * 6 + 1);
    }
    // Where the first pixel of a tile shows nothing, others are tried.
    const glm::ivec2 tries[] = {{1, 1}, {4, 1}, {1, 4}, {4, 4}};
    for (int i = 0; i < 4; ++i) {
        rooms.centers.hits(12 + tries[i].x, 6 + tries[i].y) = Hit{};
        surfaces = rooms.seen();
        if (i == 3) {
            EXPECT_EQ(surfaces.size(), 1819u);
        } else {
            ASSERT_EQ(surfaces.size(), 1820u);
            EXPECT_EQ(surfaces[54].x, 12 + tries[i + 1].x);
            EXPECT_EQ(surfaces[54].y, 6 + tries[i + 1].y);
        }
    }
    LeftHalfKnown known;
    known.half = 156;
    rooms.context.carried = &known;
    surfaces = rooms.seen();
    EXPECT_EQ(surfaces.size(), 910u);
    for (const PixelSurface& surface : surfaces) EXPECT_GE(surface.x, 156);
}

TEST(BouncePlaces, SmallPicturesHaveFewerTilesAndTilesEndAtThePicture) {
    EXPECT_EQ(Rooms(120, 80).seen().size(), 40u * 27u);  // one pixel in ten: 3 wide
    EXPECT_EQ(Rooms(60, 40).seen().size(), 20u * 14u);   // 300, rounded to 3 wide
    EXPECT_EQ(Rooms(3, 2).seen().size(), 6u);
    for (const glm::ivec2 size :
         {glm::ivec2(313, 208), glm::ivec2(312, 211)}) {  // the last tiles are one pixel wide, and high
        const std::vector<PixelSurface> seen = Rooms(size.x, size.y).seen();
        EXPECT_EQ(seen.size(), 1820u);
        for (const PixelSurface& surface : seen) EXPECT_TRUE(surface.x < size.x && surface.y < size.y);
    }
}

TEST(BouncePlaces, RaysLieInTheStrataOfEachSurface) {
    Rooms rooms(20, 20);
    std::vector<PixelSurface> surfaces = rooms.seen();
    ASSERT_EQ(surfaces.size(), 400u);
    surfaces.resize(20);
    RayCounts counts;
    const BouncePlaces places = cast_bounce_places(rooms.lighting, surfaces, 7, counts);
    ASSERT_EQ(places.hits.width, 16);
    ASSERT_EQ(places.hits.height, 20);
    EXPECT_FLOAT_EQ(places.solid_angle, static_cast<float>(pi / 1024.0));
    EXPECT_EQ(counts.gather, 16u * 20u);
    for (int y = 0; y < 20; ++y) {
        const SurfacePoint& from = surfaces[static_cast<std::size_t>(y)].point;
        const Basis basis = make_basis(from.normal);
        RandomStream random(make_place_key(7 ^ 0x626f756eu, surfaces[static_cast<std::size_t>(y)].hit));
        const CellNumbers numbers(random);
        for (int x = 0; x < 16; ++x) {
            const int row = x / 8, column = x % 8;
            const glm::vec3 direction = places.directions(x, y);
            const double elevation = (row + static_cast<double>(numbers.place(row, column).x)) / 2.0;
            const double azimuth = 2.0 * pi * (column + static_cast<double>(numbers.place(row, column).y)) / 8.0;
            const double radius = std::sqrt(elevation);
            expect_near(basis.to_local(direction),
                        {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1.0 - elevation)}, 1e-6);
            const double distance = 2.0 / direction.y;
            ASSERT_EQ(places.hits(x, y).instance, 1);
            EXPECT_NEAR(places.hits(x, y).distance, distance, 1e-5 * distance);
            const PixelSurface met = make_bounce_surface(rooms.stage.shading, places, x, y);
            expect_near(met.point.position, from.position + direction * static_cast<float>(distance), 1e-4 * distance);
            EXPECT_EQ(met.view, -direction);
            EXPECT_NEAR(met.footprint, distance * std::sqrt(pi / 1024.0), 1e-4 * distance);
            EXPECT_EQ(met.hit.distance, places.hits(x, y).distance);
            EXPECT_EQ(met.pixel, static_cast<std::uint32_t>(16 * y + x));
            EXPECT_EQ(met.x, x);
            EXPECT_EQ(met.y, y);
        }
    }
}

TEST(BouncePlaces, DirectionsBelowTheTrueSurfaceMeetNothing) {
    Rooms rooms(20, 20);
    std::vector<PixelSurface> surfaces = rooms.seen();
    surfaces.resize(1);
    surfaces[0].point.normal = {0.8f, 0.6f, 0.0f};
    RayCounts counts;
    const BouncePlaces places = cast_bounce_places(rooms.lighting, surfaces, 7, counts);
    std::uint64_t above = 0;
    for (int x = 0; x < 16; ++x) {
        const bool up_there = places.directions(x, 0).y > 0.0f;
        above += up_there ? 1 : 0;
        EXPECT_EQ(places.hits(x, 0).instance, up_there ? 1 : no_index);
    }
    EXPECT_EQ(counts.gather, above);
    EXPECT_LT(above, 16u);
}

TEST(BouncePlaces, PlacesToFill) {
    Rooms rooms(20, 20);
    std::vector<PixelSurface> surfaces = rooms.seen();
    surfaces.resize(10);
    RayCounts counts;
    BouncePlaces places = cast_bounce_places(rooms.lighting, surfaces, 7, counts);
    places.hits(0, 0) = places.hits(46, 3) = Hit{};  // of the second and of the last try
    places.hits(5, 3) = Hit{};
    for (int x = 0; x < 16; ++x) places.hits(x, 5) = Hit{};
    const FillPlaces fill = make_fill_places(rooms.stage.shading, places);
    for (const auto [x, y] : all_pixels(16, 10)) {
        if (places.hits(x, y).instance == no_index) {
            EXPECT_LT(fill.points(x, y).footprint, 0.0f);
            continue;
        }
        const PixelSurface met = fill.surface_at(x, y);
        EXPECT_EQ(fill.points(x, y).position, met.point.position);
        EXPECT_EQ(fill.points(x, y).footprint, met.footprint);
        EXPECT_EQ(fill.points(x, y).normal, met.point.normal);
    }
}

TEST(FurtherBounces, OneFewerThanThePictureHas) {
    RenderSettings settings = plain_settings(0.1, 64);
    const Rooms rooms(3, 2);
    const FurtherBounces known{make_cache(rooms.stage.shading), 0.5f};
    const auto light = [&] { return make_multi_bounce_light(settings, &known); };
    settings.light.bounces = 4;
    settings.light.path_depth = 9;
    EXPECT_EQ(count_bounces(settings), 4);
    EXPECT_EQ(light().bounces, 3);
    EXPECT_EQ(light().cache, &known.cache);
    EXPECT_NEAR(light().accuracy, 1.4 * 0.5, 1e-6);  // as far as shading reaches
    EXPECT_EQ(make_multi_bounce_light(settings, nullptr).cache, nullptr);
    settings.light.path_depth = 3;
    EXPECT_EQ(count_bounces(settings), 2);
    EXPECT_EQ(light().bounces, 1);
    settings.light.bounces = 0;
    EXPECT_EQ(light().bounces, 0);
}

TEST(FurtherBounces, RecordsCloseGapsBeyondTheirReach) {
    Rooms rooms(3, 2);
    IrradianceCache cache = make_cache(rooms.stage.shading);
    IrradianceRecord record{.radius = 1.0f, .normal = up, .irradiance = Rgb(3.0f)};
    record.accuracy = 0.4f;
    cache.insert(record);
    cache.finish();
    cache.prepare();
    const MultiBounceLight light{.bounces = 1, .cache = &cache, .accuracy = 0.4f};
    RayTask task(rooms.stage.rays);
    for (const auto& [distance, reached] : {std::pair(0.3f, true), {0.54f, true}, {0.58f, false}}) {
        const auto found = find_cached_irradiance(task, make_point({distance, 0.0f, 0.0f}, up), light);
        ASSERT_EQ(found.has_value(), reached) << distance;
        if (!reached) continue;
        EXPECT_NEAR(found->x, 3.0, 1e-5) << distance;
    }
}

TEST(CacheBounds, RadiiFollowPixelsAndAccuracy) {
    Rooms rooms(8, 8);
    rooms.settings.cache.min_radius_pixels = 4.0;
    const auto expect = [&](float footprint, float accuracy, double min, double spread) {
        const RadiusBounds bounds = radius_bounds(rooms.context, footprint, accuracy);
        EXPECT_NEAR(bounds.min, min, 1e-6 * min);
        EXPECT_EQ(bounds.max, 3.0f);
        EXPECT_NEAR(bounds.min_spread, spread, 1e-6 * spread);
    };
    expect(0.01f, 0.25f, 0.04, 0.02);
    expect(0.01f, 0.04f, 0.01 * 0.7 / 0.04, 0.05);
    expect(0.01f, 4.0f, 0.04, 0.01);
    expect(1.0f, 0.25f, 3.0, 2.0);
    expect(1e-4f, 0.0f, 1e-4 * 700.0, 1e-4 / std::sqrt(1e-3));
    // Half the diagonal of the scene.
    EXPECT_NEAR(scene_radius(rooms.stage.shading), 0.5 * std::hypot(4000.0, 4000.0, 2.0), 1.0);
    EXPECT_FLOAT_EQ(scene_radius(Stage(Scene{}).shading), std::sqrt(3.0f));
}

TEST(CacheBounds, KeysOfPlacesAreCellsOfTheTriangle) {
    const RandomKey key = make_place_key(9, {.instance = 3, .primitive = 8, .u = 0.5f, .v = 0.2501f});
    EXPECT_EQ(key.seed, 9u);
    EXPECT_EQ(key.frame, 3u);
    EXPECT_EQ(key.pixel, 8u);
    EXPECT_EQ(key.sample, 128u << 16 | 64u);
    EXPECT_EQ(make_place_key(9, {.u = -0.1f, .v = 0.9999f}).sample, 255u);
}

}  // namespace
}  // namespace aleph
