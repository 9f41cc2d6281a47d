// The work of a look-up in indices of very different sizes.

#include <gtest/gtest.h>

#include <random>

#include "render/cache/record_index.h"

namespace aleph {
namespace {

/// Records on a square of 1 m, each reaching a few of its neighbours, and ten that reach far.
RecordIndex make_square(int side) {
    RecordIndex index(glm::vec3(0.0f), glm::vec3(1.0f));
    const float spacing = 1.0f / static_cast<float>(side);
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 place(static_cast<float>(i % side) + 0.5f, static_cast<float>(i / side) + 0.5f);
        const bool far = i % (side * side / 10) == 0;
        index.add(spacing * glm::vec3(place.x, 0.0f, place.y), {far ? 0.25f : 2.0f * spacing}, 0.75f);
    }
    return index;
}

/// Cells asked and records visited by a look-up at a random place.
double work_of_look_up(const RecordIndex& index) {
    constexpr int look_ups = 2000;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::size_t work = 0, found = 0;
    for (int i = 0; i < look_ups; ++i) {
        const glm::vec3 place(unit(engine), 0.0f, unit(engine));
        index.visit(
            [&](const RecordIndex::Cell& cell) {
                ++work;
                return cell.distance_to(place) <= cell.most.at(0.75f);
            },
            [&](int) {
                ++work;
                return true;
            });
        index.visit_near(place, 0.75f, 0.0f, [&](int) {
            ++found;
            return true;
        });
    }
    EXPECT_GT(found, 2u * look_ups);
    return static_cast<double>(work) / look_ups;
}

// A walk over all records would give 1000.
TEST(IrradianceCache, IC15_AThousandTimesTheRecordsAreLessThanTenTimesTheWork) {
    const double thousand = work_of_look_up(make_square(32)), million = work_of_look_up(make_square(1000));
    EXPECT_LT(million, 10.0 * thousand) << thousand << " and " << million;
}

}  // namespace
}  // namespace aleph
