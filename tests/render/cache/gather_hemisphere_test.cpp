// Gathers in rooms: at smooth-shaded facets, in edges, and their estimate of their own noise.
// Strata of the hemisphere, and the ray of each, against formulas in double.

#include "render/cache/gather.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A sphere with vertex normals in the middle of a lit room, 6 m wide.
struct BallInRoom : Gathering {
    static constexpr double radius = 0.5;

    static Scene make_scene(int segments) {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.6), glm::dvec3(0.0), true);
        Shape ball{.kind = Shape::Kind::sphere, .radius = radius, .segments = segments};
        add_mesh(scene, make_shape_mesh(ball, white));
        add_mesh(scene, make_box(glm::dvec3(6.0), white));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? 1.5 : -1.5, i & 2 ? 1.5 : -1.5, i & 4 ? 1.5 : -1.5);
            add_light(scene, Light::Kind::point, glm::dvec3(10.0), corner);
        }
        return scene;
    }

    explicit BallInRoom(int segments) : Gathering(make_scene(segments)) {}

    /// The mean of gathers at the facet that is met from this direction, which is unit.
    IrradianceSample gather_from(const glm::vec3& from) {
        const Ray ray{from * 2.0f - glm::vec3(stage.shading.anchor), -from};
        const Hit hit = task.tracer.intersect(ray);
        SurfacePoint point = make_surface_point(stage.shading, hit, ray.direction);
        IrradianceSample mean;
        constexpr std::uint32_t count = 16;
        for (std::uint32_t seed = 0; seed < count; ++seed) {
            const IrradianceSample sample = gather(point, {choose_strata(512), {seed, 0, 0, 0}});
            mean.irradiance += sample.irradiance / static_cast<float>(count);
            mean.nearest_distance = std::min(mean.nearest_distance, sample.nearest_distance);
            mean.space.headroom = std::min(mean.space.headroom, sample.space.headroom);
            for (const float clear : sample.space.sectors)
                mean.space.sectors[0] = std::min(mean.space.sectors[0], clear);
            mean.gradients.translation[1] += sample.gradients.translation[1] / static_cast<float>(count);
        }
        return mean;
    }
};

TEST(GatherHemisphere, IC17_CoarseSmoothMeshesHaveTheRadiiOfFineOnes) {
    BallInRoom fine(512);
    for (const int segments : {12, 48}) {
        BallInRoom coarse(segments);
        for (int i = 0; i < 24; ++i) {
            const float y = 0.9f - 1.8f * (static_cast<float>(i) + 0.5f) / 24.0f, phi = 2.4f * static_cast<float>(i);
            const float across = std::sqrt(1.0f - y * y);
            const glm::vec3 from(across * std::cos(phi), y, across * std::sin(phi));
            const IrradianceSample expected = fine.gather_from(from), found = coarse.gather_from(from);
            SCOPED_TRACE(testing::Message() << segments << " segments, point " << i);
            EXPECT_NEAR(found.irradiance.y, expected.irradiance.y, 0.05f * expected.irradiance.y);
            EXPECT_NEAR(found.nearest_distance, expected.nearest_distance, 0.05f * expected.nearest_distance);
            EXPECT_NEAR(found.space.sectors[0], expected.space.sectors[0], 0.15f * expected.space.sectors[0]);
            EXPECT_EQ(std::isinf(found.space.headroom), std::isinf(expected.space.headroom));
            // The facet's own horizon is no edge that moves: the gradient stays that of the room.
            const float gradient = glm::length(found.gradients.translation[1] - expected.gradients.translation[1]);
            EXPECT_LT(gradient, 0.1f * expected.irradiance.y);
        }
    }
}

TEST(GatherHemisphere, IC17_NoRaysBelowTheTrueSurface) {
    Scene scene;
    add_mesh(scene, make_faceted_sphere(2.0, 32, add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.5, 1.0, 0.2});
    Gathering ball(std::move(scene));
    SurfacePoint point = make_point(glm::vec3(0.0f), up);
    point.normal = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    const IrradianceSample sample = ball.gather(point, {choose_strata(1024)});
    // At 45 degrees, (1 + cos) / 2 of the cosine-weighted hemisphere is above the surface.
    EXPECT_NEAR(static_cast<double>(ball.task.counts.gather), 1024 * 0.5 * (1.0 + std::sqrt(0.5)), 16.0);
    for (const Ray& ray : ball.scratch.rays) EXPECT_GT(ray.direction.y, 0.0f);
    EXPECT_NEAR(sample.nearest_distance, 2.0f, 0.02f);
}

/// A box of single walls, open in front.
Scene make_open_box() {
    Scene scene;
    const Mesh wall = make_quad(5.5, 5.5, add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true));
    add_mesh(scene, wall, {0.0, 0.0, -2.75});
    add_mesh(scene, wall, {0.0, 2.75, 0.0}, z_to_down);
    add_mesh(scene, wall, {0.0, -2.75, 0.0}, z_to_up);
    add_mesh(scene, wall, {-2.75, 0.0, 0.0}, turn_about_y(pi / 2));
    add_mesh(scene, wall, {2.75, 0.0, 0.0}, turn_about_y(-pi / 2));
    add_light(scene, Light::Kind::point, glm::dvec3(10.0), {0.0, 0.0, 0.0});
    return scene;
}

TEST(Gather, MC29_PointsOnTheEdgeWhereTwoWallsMeet) {
    Gathering box(make_open_box());
    const auto gather = [&](int wall, int triangle, float u, float v) {
        const Hit hit{wall, triangle, u, v, 1.0f};
        const glm::vec3 direction(0.48f, 0.64f, 0.6f);
        SurfacePoint point = make_surface_point(box.stage.shading, hit, direction);
        if (!point.front) point = make_surface_point(box.stage.shading, hit, -direction);
        return luminance(box.gather(point, {choose_strata(256), {1, 2, 3, 4}}).irradiance);
    };
    for (int wall = 0; wall < 5; ++wall) {
        for (int triangle = 0; triangle < 2; ++triangle) {
            for (const float along : {0.2f, 0.335f, 0.6f}) {
                const float rest = 1.0f - along, inside = 0.003f;
                EXPECT_GT(gather(wall, triangle, 0.0f, along), 0.8f * gather(wall, triangle, inside, along));
                EXPECT_GT(gather(wall, triangle, along, 0.0f), 0.8f * gather(wall, triangle, along, inside));
                EXPECT_GT(gather(wall, triangle, along, rest), 0.8f * gather(wall, triangle, along, rest - inside));
            }
        }
    }
}

/// The mean over points. At single points, where light varies smoothly, the estimate is up to twice the spread.
TEST(GatherNoise, TheEstimateIsTheSpreadOverSeeds) {
    Gathering room(make_cluttered_room());
    const SurfacePoint points[] = {make_point({-0.2f, -1.499f, -0.2f}, up), make_point({0.3f, -1.499f, 1.2f}, up),
                                   make_point({1.999f, 0.3f, 0.8f}, {-1.0f, 0.0f, 0.0f}),
                                   make_point({-1.999f, -0.6f, -0.6f}, {1.0f, 0.0f, 0.0f}),
                                   make_point({0.4f, 1.499f, 1.5f}, {0.0f, -1.0f, 0.0f})};
    for (const int samples : {16, 61, 256, 1024}) {
        double ratio = 0.0;
        for (const SurfacePoint& point : points) {
            Mean light, variance;
            for (std::uint32_t seed = 0; seed < 64; ++seed) {
                const IrradianceSample sample = room.gather(point, {choose_strata(samples), {seed, 7, 0, 0}});
                light.add(luminance(sample.irradiance));
                variance.add(static_cast<double>(sample.relative_error) * sample.relative_error);
            }
            const double spread = light.error() * 8.0 / light.mean();
            ratio += std::sqrt(variance.mean()) / spread / 5.0;
        }
        EXPECT_NEAR(ratio, 1.0, 0.3) << samples;
    }
}

TEST(GatherNoise, EdgesOfTheEstimate) {
    Gathering room(make_cluttered_room());
    const auto error_of = [&](int samples) { return room.at({-0.2f, -1.499f, -0.2f}, up, samples).relative_error; };
    EXPECT_TRUE(std::isinf(error_of(1)));
    EXPECT_TRUE(std::isinf(error_of(2)));
    for (int samples = 16; samples < 64; ++samples) {
        EXPECT_TRUE(std::isfinite(error_of(samples))) << samples;
        EXPECT_GE(choose_strata(samples).rows, 2) << samples;
    }
    Scene dark;
    add_mesh(dark, make_faceted_sphere(2.0, 16, add_lambert(dark, glm::dvec3(0.5))));
    EXPECT_EQ(Gathering(std::move(dark)).at(glm::vec3(0.0f), up, 64).relative_error, 0.0f);
}

TEST(GatherRays, StrataOfSomeSizes) {
    const struct {
        int samples, rows, columns;
    } cases[] = {{0, 1, 1},  {1, 1, 1},   {2, 1, 2},   {3, 1, 3},   {7, 1, 7},     {12, 2, 6},    {13, 2, 6},
                 {27, 3, 9}, {64, 4, 16}, {75, 5, 15}, {96, 6, 16}, {512, 16, 32}, {1024, 16, 64}};
    for (const auto& c : cases) {
        const HemisphereStrata strata = choose_strata(c.samples);
        EXPECT_EQ(strata.rows, c.rows) << c.samples;
        EXPECT_EQ(strata.columns, c.columns) << c.samples;
    }
}

TEST(GatherRays, BlocksHaveEveryCellOnce) {
    for (const auto& strata : {HemisphereStrata{1, 2}, {5, 2}, {6, 2}, {10, 1}, {10, 3}}) {
        std::set<int> cells;
        visit_blocks(strata, [&](int cell, int row, int column) {
            EXPECT_EQ(cell, row * strata.columns + column);
            EXPECT_TRUE(row < strata.rows && column < strata.columns && cells.insert(cell).second) << cell;
        });
        EXPECT_EQ(std::ssize(cells), strata.count());
    }
}

double part_after_point(double x) {
    return x - std::floor(x);
}

TEST(GatherRays, NumbersOfCellsAreKroneckerSequences) {
    const RandomKey key{1, 2, 3, 4};
    RandomStream random(key), shifts(key);
    const CellNumbers numbers(random);
    float shift[5];
    for (float& s : shift) s = shifts.next();
    EXPECT_EQ(random.next(), shifts.next());
    for (const int row : {0, 1, 5, 40}) {
        for (const int column : {0, 1, 3, 90}) {
            const auto expect = [&](float found, int dimension, double by_row, double by_column) {
                EXPECT_NEAR(found, part_after_point(shift[dimension] + row * by_row + column * by_column), 2e-5);
            };
            expect(numbers.place(row, column).x, 0, 0.0, 0.61803399);
            expect(numbers.place(row, column).y, 1, 0.41421356, 0.0);
            expect(numbers.light(row, column), 2, 0.75487767, 0.56984029);
            expect(numbers.light_point(row, column).x, 3, 0.81917251, 0.67104361);
            expect(numbers.light_point(row, column).y, 4, 0.41421356, 0.61803399);
        }
    }
}

TEST(GatherRays, SectorsAreSixteenthsOfTheCircle) {
    std::set<int> sectors;
    for (int i = 0; i < 16; ++i) {
        const auto at = [&](double degrees) {
            const double angle = (22.5 * i + degrees) * pi / 180.0;
            return sector_of(static_cast<float>(3.0 * std::cos(angle)), static_cast<float>(3.0 * std::sin(angle)));
        };
        EXPECT_EQ(at(0.01), at(22.49)) << i;
        EXPECT_NE(at(0.01), at(-0.01)) << i;
        EXPECT_GE(at(11.0), 0);
        EXPECT_LT(at(11.0), 16);
        sectors.insert(at(11.0));
    }
    EXPECT_EQ(sectors.size(), 16u);
}

struct Placed {
    HemisphereStrata strata;
    SurfacePoint point;
    Basis basis;
    GatherScratch scratch;
    const RandomKey key{7, 0, 0, 0};

    Placed(const HemisphereStrata& s, const glm::vec3& normal, const glm::vec3& geometric)
        : strata(s), point(make_point({1.0f, 2.0f, 3.0f}, normal)), basis(make_basis(normal)) {
        point.geometric = geometric;
        RandomStream random(key);
        place_rays(strata, basis, point, CellNumbers(random), scratch);
    }

    glm::dvec3 direction(const RayPlace& place) const {
        RandomStream random(key);
        const glm::vec2 number = CellNumbers(random).place(place.row, place.column);
        const double elevation = (place.row + static_cast<double>(number.x)) / strata.rows;
        const double azimuth = 2.0 * pi * (place.column + static_cast<double>(number.y)) / strata.columns;
        return glm::dvec3(basis.tangent) * (std::sqrt(elevation) * std::cos(azimuth)) +
               glm::dvec3(basis.bitangent) * (std::sqrt(elevation) * std::sin(azimuth)) +
               glm::dvec3(basis.normal) * std::sqrt(1.0 - elevation);
    }
};

TEST(GatherRays, MC04_OneRayLiesInEachCell) {
    std::vector<std::pair<HemisphereStrata, glm::vec3>> cases{{{6, 16}, up},  // more than one block
                                                              {{6, 16}, {0.48f, -0.6f, 0.64f}},
                                                              {{8, 16}, {0.0f, 0.0f, 1.0f}}};
    for (const int n : {2, 3, 7, 17, 512, 8191, 8192}) cases.emplace_back(choose_strata(n), up);
    for (const auto& [strata, normal] : cases) {
        const Placed placed(strata, normal, normal);
        const auto count = static_cast<std::size_t>(strata.count());
        ASSERT_EQ(placed.scratch.rays.size(), count);
        ASSERT_EQ(placed.scratch.places.size(), count);
        ASSERT_EQ(placed.scratch.hits.size(), count);
        std::set<int> cells;
        for (std::size_t i = 0; i < count; ++i) {
            const RayPlace& place = placed.scratch.places[i];
            EXPECT_EQ(placed.strata.cell(place.row, place.column), place.cell);
            cells.insert(place.cell);
            const Ray& ray = placed.scratch.rays[i];
            // In single precision; the narrowest cell is .04 wide.
            expect_near(ray.direction, placed.direction(place), count < 500 ? 5e-7 : 1e-5);
            EXPECT_EQ(ray.origin, placed.point.ray_origin());
            EXPECT_EQ(placed.scratch.below[i], 0);
        }
        EXPECT_EQ(cells.size(), count);
    }
}

TEST(GatherRays, RaysBelowTheTrueSurfaceAreLeftOut) {
    const glm::vec3 normal(0.0f, 1.0f, 0.0f), geometric(0.48f, 0.6f, 0.64f);
    const Placed placed({6, 16}, normal, geometric);
    std::vector<int> rays(96, 0);
    for (std::size_t i = 0; i < placed.scratch.rays.size(); ++i) {
        EXPECT_GT(glm::dot(placed.scratch.rays[i].direction, geometric), 0.0f);
        expect_near(placed.scratch.rays[i].direction, placed.direction(placed.scratch.places[i]), 5e-7);
        ++rays[placed.scratch.places[i].cell];
    }
    int expected_count = 0;
    for (int cell = 0; cell < 96; ++cell) {
        const RayPlace place{cell, cell / 16, cell % 16};
        const int expected = glm::dot(placed.direction(place), glm::dvec3(geometric)) > 1e-6 ? 1 : 0;
        EXPECT_EQ(rays[cell], expected) << cell;
        EXPECT_EQ(placed.scratch.below[cell] != 0, expected == 0) << cell;
        expected_count += expected;
    }
    EXPECT_EQ(placed.scratch.rays.size(), static_cast<std::size_t>(expected_count));
    EXPECT_GT(expected_count, 60);
    EXPECT_LT(expected_count, 95);
}

}  // namespace
}  // namespace aleph
