// Yee 2000, eqs. 6.7 and 6.8: known values, the ends of their ranges, and the unguided accuracy, which no adapter
// changes.

#include "render/guide/accuracy_map.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(AccuracyMap, CompressIsTheAmbientAccuracyWhereNothingIsTolerated) {
    for (const double a : {1e-6, 0.05, 0.1, 0.5, 1.0}) EXPECT_DOUBLE_EQ(compress_accuracy(a, 1.0), a);
}

TEST(AccuracyMap, CompressKnownAnswers) {
    EXPECT_DOUBLE_EQ(compress_accuracy(0.1, 10.0), 1.0 / 1.9);
    EXPECT_DOUBLE_EQ(compress_accuracy(0.5, 3.0), 0.75);
    EXPECT_NEAR(compress_accuracy(0.1, 250.6), 25.06 / 25.96, 1e-12);
}

TEST(AccuracyMap, CompressAtItsEnds) {
    EXPECT_EQ(compress_accuracy(0.1, infinity), 1.0);
    EXPECT_EQ(compress_accuracy(1.0, 77.0), 1.0);
    for (const double n : {0.0, 1.0, 250.0, infinity, not_a_number}) EXPECT_EQ(compress_accuracy(0.0, n), 0.0);
    for (const double n : {0.0, -5.0, not_a_number, -infinity}) EXPECT_DOUBLE_EQ(compress_accuracy(0.1, n), 0.1);
    EXPECT_EQ(compress_accuracy(not_a_number, 2.0), 0.0);
    EXPECT_LE(compress_accuracy(0.3, 1e300), 1.0);
}

TEST(AccuracyMap, BothGrowWithTheElevationAndStayWithinOne) {
    for (const double a : {0.01, 0.15, 0.9}) {
        double before_compress = 0.0, before_add = 0.0;
        for (double n = 1.0; n < 260.0; n += 0.5) {
            const double compress = compress_accuracy(a, n), add = scale_add_accuracy(a, n, 100.0);
            EXPECT_GT(compress, before_compress);
            EXPECT_LT(compress, 1.0);
            EXPECT_GE(compress, a * (1.0 - 1e-12));
            EXPECT_GE(add, before_add);
            EXPECT_LE(add, 1.0);
            before_compress = compress;
            before_add = add;
        }
    }
}

TEST(AccuracyMap, ScaleAddKnownAnswers) {
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 1.0, 100.0), 0.11);
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 50.0, 100.0), 0.6);
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 50.0, 200.0), 0.35);
    EXPECT_EQ(scale_add_accuracy(0.1, 250.0, 100.0), 1.0);  // the equation gives 2.6
    EXPECT_EQ(scale_add_accuracy(0.1, infinity, 100.0), 1.0);
    EXPECT_EQ(scale_add_accuracy(1.0, 1.0, 100.0), 1.0);
    for (const double n : {0.0, -3.0, not_a_number}) EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, n, 100.0), 0.11);
    for (const double n : {1.0, infinity, not_a_number}) EXPECT_EQ(scale_add_accuracy(0.0, n, 100.0), 0.0);
}

TEST(AccuracyMap, MapPixelByPixel) {
    Image<float> aleph(2, 2);
    aleph.pixels = {1.0f, 10.0f, float_infinity, float_nan};
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.perception.guide = Guide::saliency;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels,
              (std::vector<float>{0.1f, static_cast<float>(1.0 / 1.9), 1.0f, 0.1f}));
    settings.guide.adapter = Adapter::scale_add;
    settings.guide.adapter_k = 50.0;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels,
              (std::vector<float>{0.12f, static_cast<float>(0.3), 1.0f, 0.12f}));
    settings.guide.adapter = Adapter::none;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels, std::vector<float>(4, 0.1f));
}

TEST(AccuracyMap, WithoutAGuideNoAdapterCounts) {
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.perception.guide = Guide::none;
    for (const Adapter adapter : {Adapter::compress, Adapter::scale_add, Adapter::none}) {
        settings.guide.adapter = adapter;
        for (const float alpha : compute_accuracy_map(Image<float>(3, 2, 100.0f), settings).pixels)
            EXPECT_EQ(alpha, 0.1f);
    }
}

/// Twice the accuracy on the left, NaN on the right.
struct LeftAdapter final : AccuracyAdapter {
    Image<float> adapt(const Image<float>& aleph, double accuracy) const override {
        Image<float> alpha(width, aleph.height, std::numeric_limits<float>::quiet_NaN());
        for (int y = 0; y < alpha.height; ++y) alpha(0, y) = static_cast<float>(20.0 * accuracy);
        return alpha;
    }
    int width = 2;
};

TEST(AccuracyMap, AnAdapterOfAProgramIsAskedAndHeldToItsRange) {
    LeftAdapter own;
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.guide.own_adapter = &own;
    EXPECT_EQ(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings).pixels, (std::vector<float>{1.0f, 0.1f}));
    own.width = 3;
    EXPECT_THROW(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings), InputError);
    settings.perception.guide = Guide::none;
    EXPECT_EQ(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings).pixels, std::vector<float>(2, 0.1f));
}

}  // namespace
}  // namespace aleph
