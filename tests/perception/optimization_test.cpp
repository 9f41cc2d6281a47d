// The maps of the optimized library against those of the same sources compiled without optimization.

#include <cstdio>

#include "tests/support/paths.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Optimization, DT07_MapsAreThoseOfABuildWithoutIt) {
    const std::vector<float> optimized = all_maps();
    std::vector<float> plain(optimized.size() + 1);
    FILE* stream = popen(program_path("unoptimized_maps").c_str(), "r");
    ASSERT_NE(stream, nullptr);
    const std::size_t count = std::fread(plain.data(), sizeof(float), plain.size(), stream);
    EXPECT_EQ(pclose(stream), 0);
    ASSERT_EQ(count, optimized.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double difference = std::abs(static_cast<double>(optimized[i]) - plain[i]);
        ASSERT_LE(difference, 1e-6 * std::max(1.0, std::abs(static_cast<double>(plain[i])))) << i;
        largest = std::max(largest, difference);
    }
    RecordProperty("largest_difference", std::to_string(largest));
}

}  // namespace
}  // namespace aleph
