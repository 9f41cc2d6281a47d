// Opponent colours against the printed matrices in double, and pixels that are no colours.

#include <glm/matrix.hpp>

#include "engine/base/opponent_color.h"
#include "engine/base/sampling.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// (A, C1, C2) in double: linear Rec.709 to XYZ (IEC 61966-2-1) to AC1C2 (Meyer 1988), rows as printed.
glm::dvec3 to_opponent(const glm::dvec3& rgb) {
    const glm::dmat3 xyz_rows({0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505});
    const glm::dmat3 opponent_rows({-0.0177, 1.0090, 0.0073}, {-1.5370, 1.0821, 0.3209}, {0.1946, -0.2045, 0.5264});
    return glm::transpose(opponent_rows) * (glm::transpose(xyz_rows) * rgb);
}

TEST(OpponentColor, PY15_GreyIsNeutralOnlyAfterNeutralSubtraction) {
    for (const float y : {1.0f, 0.18f, 1e6f}) {
        const auto grey = [&](OpponentChannel channel, bool neutral) {
            return compute_opponent(Image<Rgb>(3, 1, Rgb(y)), channel, neutral)(1, 0) / y;
        };
        for (const bool neutral : {false, true}) EXPECT_NEAR(grey(OpponentChannel::a, neutral), 1.0, 5e-4);
        EXPECT_NEAR(grey(OpponentChannel::c1, false), -0.029, 5e-4);
        EXPECT_NEAR(grey(OpponentChannel::c2, false), 0.554, 5e-4);
        EXPECT_NEAR(grey(OpponentChannel::c1, true), 0.0, 1e-6);
        EXPECT_NEAR(grey(OpponentChannel::c2, true), 0.0, 1e-6);
    }
}

TEST(OpponentColor, PY15_RowsAgreeWithTheDoubleMatrix) {
    Image<Rgb> image(257, 3);
    RandomStream random({12, 0, 0, 0});
    for (Rgb& c : image.pixels) c = {random.next(), random.next(), random.next()};
    const auto a = compute_opponent(image, OpponentChannel::a, false);
    const auto c1 = compute_opponent(image, OpponentChannel::c1, false);
    const auto c2 = compute_opponent(image, OpponentChannel::c2, false);
    for (std::size_t i = 0; i < image.size(); ++i) {
        const glm::dvec3 exact = to_opponent(glm::dvec3(image.pixels[i]));
        EXPECT_NEAR(a.pixels[i], exact.x, 3e-7);
        EXPECT_NEAR(c1.pixels[i], exact.y, 3e-7);
        EXPECT_NEAR(c2.pixels[i], exact.z, 3e-7);
    }
}

TEST(OpponentColor, PY15_OutOfGamutAndBrokenPixelsAreClampedFirst) {
    Image<Rgb> image(7, 1);
    image.pixels = {Rgb(-1, 0.5f, 0.5f),
                    Rgb(0, 0.5f, 0.5f),
                    Rgb(float_nan, 0.5f, 0.5f),
                    Rgb(0.0f),
                    Rgb(-0.0f),
                    Rgb(float_infinity),
                    Rgb(std::numeric_limits<float>::max())};
    for (const OpponentChannel channel : {OpponentChannel::a, OpponentChannel::c1, OpponentChannel::c2}) {
        const Image<float> out = compute_opponent(image, channel, false);
        EXPECT_EQ(out(0, 0), out(1, 0));
        EXPECT_EQ(out(2, 0), out(1, 0));
        EXPECT_EQ(out(3, 0), 0.0f);
        EXPECT_EQ(out(4, 0), 0.0f);
        const double clamped = to_opponent(glm::dvec3(1e15))[static_cast<int>(channel)];
        EXPECT_NEAR(out(5, 0) / clamped, 1.0, 1e-5);
        EXPECT_EQ(out(6, 0), out(5, 0));
    }
}

}  // namespace
}  // namespace aleph
