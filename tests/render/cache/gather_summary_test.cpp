// The summary of a hemisphere against its formulas, written anew in double.

#include "render/cache/gather.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The findings of the rays of a hemisphere; each cell has one ray, through its middle.
struct Hemisphere {
    HemisphereStrata strata;
    Basis basis = make_basis(glm::vec3(0.48f, -0.6f, 0.64f));
    GatherScratch scratch;

    explicit Hemisphere(const HemisphereStrata& s, float radiance = 1.0f, float distance = 2.0f) : strata(s) {
        const auto cells = static_cast<std::size_t>(strata.count());
        scratch.radiance.assign(cells, Rgb(radiance));
        scratch.distances.assign(cells, distance);
        scratch.below.assign(cells, 0);
        for (int row = 0; row < strata.rows; ++row) {
            for (int column = 0; column < strata.columns; ++column) add_ray(row, column);
        }
    }
    void add_ray(int row, int column) {
        const float height = std::sqrt(1.0f - elevation(row)), radius = std::sqrt(elevation(row));
        const auto angle = static_cast<float>(azimuth(column));
        const glm::vec3 local(radius * std::cos(angle), radius * std::sin(angle), height);
        scratch.rays.push_back({glm::vec3(0.0f), basis.to_world(local)});
        scratch.places.push_back({strata.cell(row, column), row, column});
        scratch.hits.push_back({.instance = 0, .distance = scratch.distances[0]});
        scratch.light.emplace_back(scratch.radiance[0]);
    }
    void set_distance(int row, int column, float distance) {
        const auto cell = static_cast<std::size_t>(strata.cell(row, column));
        scratch.distances[cell] = distance;
        scratch.hits[cell].distance = distance;
        if (std::isinf(distance)) scratch.hits[cell].instance = no_index;
    }
    float elevation(int row) const { return (static_cast<float>(row) + 0.5f) / static_cast<float>(strata.rows); }
    double azimuth(int column) const { return 2.0 * pi * (column + 0.5) / strata.columns; }

    IrradianceSample summarize() {
        IrradianceSample out;
        summarize_hemisphere(strata, basis, scratch, out);
        return out;
    }
};

double number_of(int cell, int dimension) {
    return RandomStream({5, 0, static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(dimension)}).at(0);
}

TEST(GatherSummary, LightThatFewRaysFindIsTakenApart) {
    const HemisphereStrata strata{8, 8};
    Hemisphere hemisphere(strata);
    std::vector<Rgb>& light = hemisphere.scratch.light;
    light[3] = Rgb(4.0f);  // four times what others find is not rare
    EXPECT_EQ(take_rare_light(strata, hemisphere.scratch), Rgb(0.0f));
    light[7] = Rgb(100.0f, 200.0f, 0.0f);
    light[40] = Rgb(50.0f);
    const std::vector<Rgb> before = light;
    const Rgb taken = take_rare_light(strata, hemisphere.scratch);
    Rgb difference(0.0f);
    for (std::size_t i = 0; i < light.size(); ++i) {
        difference += before[i] - light[i];
        EXPECT_LE(luminance(light[i]), 4.0f + 1e-5f);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(taken[c], difference[c] * pi / 64.0, 1e-5);
    EXPECT_EQ(light[7].x * 2.0f, light[7].y) << "of the same colour";
    for (int i : {10, 20, 30, 50}) light[static_cast<std::size_t>(i)] = Rgb(90.0f);
    EXPECT_EQ(take_rare_light(strata, hemisphere.scratch), Rgb(0.0f)) << "four rays find it";
}

TEST(GatherSummary, GradientsAreWardAndHeckberts) {
    for (const HemisphereStrata& strata : {HemisphereStrata{3, 7}, HemisphereStrata{1, 4}, HemisphereStrata{5, 2}}) {
        Hemisphere hemisphere(strata);
        GatherScratch& scratch = hemisphere.scratch;
        for (int row = 0; row < strata.rows; ++row) {
            for (int column = 0; column < strata.columns; ++column) {
                const int cell = strata.cell(row, column);
                for (int c = 0; c < 3; ++c) scratch.radiance[cell][c] = static_cast<float>(number_of(cell, c));
                hemisphere.set_distance(row, column, static_cast<float>(0.5 + number_of(cell, 3)));
            }
        }
        scratch.below[strata.cell(strata.rows - 1, 1)] = 1;
        hemisphere.set_distance(0, 0, float_infinity);
        const IrradianceSample found = hemisphere.summarize();

        const auto tangent = glm::dvec3(hemisphere.basis.tangent), bitangent = glm::dvec3(hemisphere.basis.bitangent);
        const auto outwards = [&](double angle) { return tangent * std::cos(angle) + bitangent * std::sin(angle); };
        const auto around = [&](double angle) { return bitangent * std::cos(angle) - tangent * std::sin(angle); };
        const auto parallax = [&](int a, int b) {
            if (scratch.below[a] != 0 || scratch.below[b] != 0) return 0.0;
            return 1.0 / std::min(scratch.distances[a], scratch.distances[b]);
        };
        for (int c = 0; c < 3; ++c) {
            glm::dvec3 rotation(0.0), translation(0.0);
            for (int k = 0; k < strata.columns; ++k) {
                for (int j = 0; j < strata.rows; ++j) {
                    const int cell = strata.cell(j, k);
                    const double light = scratch.radiance[cell][c];
                    const double sine2 = (j + 0.5) / strata.rows;  // of the middle
                    const double low = static_cast<double>(j) / strata.rows, high = (j + 1.0) / strata.rows;
                    rotation += around(hemisphere.azimuth(k)) *
                                (light * std::sqrt(sine2 / (1.0 - sine2)) * pi / strata.count());
                    if (j > 0) {
                        const int above = strata.cell(j - 1, k);
                        translation += outwards(hemisphere.azimuth(k)) *
                                       (2.0 * pi / strata.columns * std::sqrt(low) * (1.0 - low) *
                                        parallax(cell, above) * (light - scratch.radiance[above][c]));
                    }
                    const int beside = strata.cell(j, (k + strata.columns - 1) % strata.columns);
                    translation += around(2.0 * pi * k / strata.columns) *
                                   ((std::sqrt(high) - std::sqrt(low)) * parallax(cell, beside) *
                                    (light - scratch.radiance[beside][c]));
                }
            }
            expect_near(found.gradients.rotation[static_cast<std::size_t>(c)], rotation, 2e-6);
            expect_near(found.gradients.translation[static_cast<std::size_t>(c)], translation, 2e-6);
        }
    }
}

TEST(GatherSummary, DistancesBelowATenThousandthOfTheMedianAreLeftOut) {
    for (const float scale : {1e-5f, 1.0f, 1e3f}) {
        Hemisphere hemisphere({3, 5}, 1.0f, scale);
        for (int i = 0; i < 15; ++i) hemisphere.set_distance(i / 5, i % 5, static_cast<float>(i + 1) * scale);
        hemisphere.set_distance(0, 0, 7.9e-4f * scale);  // the median is 8
        hemisphere.set_distance(0, 1, 8.1e-4f * scale);
        hemisphere.set_distance(0, 2, 0.0f);
        hemisphere.set_distance(1, 0, float_infinity);  // not of the median
        hemisphere.set_distance(2, 4, float_infinity);
        // Left are 0, 0.00079, 0.00081, 4, 5, 7, [8], 9, 10, 11, 12, 13, 14.
        EXPECT_EQ(hemisphere.summarize().nearest_distance, 8.1e-4f * scale);
        hemisphere.set_distance(0, 0, 1e-4f * (8.0f * scale));  // just as far counts
        EXPECT_EQ(hemisphere.summarize().nearest_distance, 1e-4f * (8.0f * scale));
    }
}

TEST(GatherSummary, WithoutHitsDistancesAreInfinite) {
    Hemisphere hemisphere({2, 4});
    for (int i = 0; i < 8; ++i) hemisphere.set_distance(i / 4, i % 4, float_infinity);
    const IrradianceSample found = hemisphere.summarize();
    EXPECT_EQ(found.nearest_distance, float_infinity);
    EXPECT_EQ(found.space.headroom, float_infinity);
    for (const float clear : found.space.sectors) EXPECT_EQ(clear, float_infinity);
    for (const glm::vec3& gradient : found.gradients.translation) EXPECT_EQ(gradient, glm::vec3(0.0f));
}

TEST(GatherSummary, RowsOfTwoRaysPerSectorClearTheWay) {
    // 32 columns have two rays in each of sixteen sectors: one row. 31 columns need two rows; 3 rows of 10 are too few.
    for (const auto& [strata, low_rows] :
         {std::pair(HemisphereStrata{4, 32}, 1), std::pair(HemisphereStrata{4, 31}, 2),
          std::pair(HemisphereStrata{4, 16}, 2), std::pair(HemisphereStrata{3, 10}, 3)}) {
        for (int row = 0; row < strata.rows; ++row) {
            Hemisphere hemisphere(strata, 1.0f, 1e3f);
            hemisphere.set_distance(row, 3, 2.0f);
            hemisphere.set_distance(row, 0, 2.5f);
            const IrradianceSample found = hemisphere.summarize();
            const bool low = row >= strata.rows - low_rows;
            const auto angle = static_cast<float>(hemisphere.azimuth(3));
            const std::size_t sector = static_cast<std::size_t>(sector_of(std::cos(angle), std::sin(angle)));
            const float along = 2.0f * std::sqrt(hemisphere.elevation(row));
            const float height = 2.0f * std::sqrt(1.0f - hemisphere.elevation(row));
            if (low) {
                EXPECT_NEAR(found.space.sectors[sector], along, 1e-5f) << row;
                EXPECT_LT(found.space.sectors[0], 2.51f) << row;
                EXPECT_GT(found.space.headroom, 100.0f);
            } else {
                EXPECT_NEAR(found.space.headroom, height, 1e-5f) << row;
                EXPECT_GT(found.space.sectors[sector], 100.0f);
            }
        }
    }
}

TEST(GatherSummary, NoiseIsThatOfMixedDifferences) {
    // One of 4 x 8 cells is brighter by 1: the four squares around it differ by 1, of 24.
    Hemisphere inside({4, 8});
    inside.scratch.radiance[static_cast<std::size_t>(inside.strata.cell(2, 3))] = Rgb(2.0f);
    EXPECT_NEAR(inside.summarize().relative_error, 0.8 * std::sqrt(32.0 * 4.0 / (4.0 * 24.0)) / 33.0, 1e-6);
    // Next to the seam too, and in the first row it is in two squares.
    Hemisphere seam({4, 8});
    seam.scratch.radiance[static_cast<std::size_t>(seam.strata.cell(0, 0))] = Rgb(2.0f);
    EXPECT_NEAR(seam.summarize().relative_error, 0.8 * std::sqrt(32.0 * 2.0 / (4.0 * 24.0)) / 33.0, 1e-6);
    // Light that is a sum of one by row and one by column has no noise.
    Hemisphere smooth({4, 8});
    for (int i = 0; i < 32; ++i) {
        smooth.scratch.radiance[static_cast<std::size_t>(i)] =
            Rgb(static_cast<float>(1 + (i / 8) * (i / 8) + (i % 8) * 3));
    }
    EXPECT_NEAR(smooth.summarize().relative_error, 0.0f, 1e-6f);
    EXPECT_EQ(Hemisphere({4, 8}, 0.0f).summarize().relative_error, 0.0f);
    EXPECT_EQ(Hemisphere({1, 8}).summarize().relative_error, float_infinity);
    EXPECT_EQ(Hemisphere({8, 1}).summarize().relative_error, float_infinity);
    EXPECT_NEAR(Hemisphere({2, 2}).summarize().relative_error, 0.0f, 1e-6f);
}

}  // namespace
}  // namespace aleph
