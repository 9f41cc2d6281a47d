// Strata of the hemisphere, and the ray of each, against formulas in double.

#include "render/cache/gather_rays.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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

TEST(GatherRays, OneRayLiesInEachCell) {
    for (const auto& [strata, normal] : {std::pair(HemisphereStrata{6, 16}, up),  // more than one block
                                         std::pair(HemisphereStrata{6, 16}, glm::vec3(0.48f, -0.6f, 0.64f)),
                                         std::pair(HemisphereStrata{8, 16}, glm::vec3(0.0f, 0.0f, 1.0f))}) {
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
            expect_near(ray.direction, placed.direction(place), 5e-7);
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
