// Gaussian pyramids against zero insertion and convolution in double (perception_reference.h).

#include "engine/base/pyramid.h"
#include "engine/base/sampling.h"
#include "tests/support/perception_reference.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Image<float> random_image(int width, int height) {
    Image<float> image(width, height);
    RandomStream random({3, 0, 0, 0});
    for (float& v : image.pixels) v = random.next();
    return image;
}

DoubleImage to_double(const Image<float>& image) {
    DoubleImage out(image.width, image.height);
    std::copy(image.pixels.begin(), image.pixels.end(), out.pixels.begin());
    return out;
}

double largest_difference(const Image<float>& a, const DoubleImage& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
    return largest;
}

class EverySize : public testing::TestWithParam<LevelSize> {};

TEST_P(EverySize, StepsAgreeWithTheDefinition) {
    const auto [width, height] = GetParam();
    const Image<float> image = random_image(width, height);
    const DoubleImage exact = to_double(image);
    EXPECT_LT(largest_difference(low_pass(image), reference_low_pass(exact)), 4e-7);
    const Image<float> coarse = reduce(image);
    EXPECT_EQ(coarse.width, (width + 1) / 2);
    EXPECT_EQ(coarse.height, (height + 1) / 2);
    EXPECT_LT(largest_difference(coarse, reference_reduce(exact)), 4e-7);
    EXPECT_LT(largest_difference(expand(coarse, {width, height}), reference_expand(to_double(coarse), width, height)),
              4e-7);
}

TEST_P(EverySize, RowsExpandedAloneHaveTheSameBits) {
    const auto [width, height] = GetParam();
    const std::vector<Image<float>> levels = make_gaussian_pyramid(random_image(width, height), 6);
    const std::vector<LevelSize> sizes = pyramid_sizes(width, height, 6);
    RowExpander expander(sizes);
    std::vector<float> row(static_cast<std::size_t>(width));
    for (int level = 0; level < 6; ++level) {
        const Image<float>& image = levels[level];
        const Image<float> whole = expand_to_level(image, sizes, level, 0);
        ASSERT_EQ(whole.width, width);
        for (int begin = 0; begin < height; begin += 5) {
            const int end = std::min(begin + 5, height);
            expander.load(image, level, begin, end);
            for (int y = begin; y < end; ++y) {
                expander.expand_row(y, row.data());
                ASSERT_TRUE(std::equal(row.begin(), row.end(), whole.row(y))) << level << " row " << y;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Pyramid, EverySize,
                         testing::Values(LevelSize{1, 1}, LevelSize{2, 2}, LevelSize{1, 9}, LevelSize{9, 1},
                                         LevelSize{2, 5}, LevelSize{3, 4}, LevelSize{17, 33}, LevelSize{64, 48},
                                         LevelSize{101, 70}));

}  // namespace
}  // namespace aleph
