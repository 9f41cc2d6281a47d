// Parts of a picture.

#include "render/pixels/picture_part.h"

#include "tests/support/all_pixels.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(PictureParts, AnAreaIsMarkedWithThePixelsAroundIt) {
    PicturePart part(9, 7, std::uint8_t{0});
    mark_area(part, {4, 1, 2, 1}, 1);
    mark_area(part, {0, 6, 1, 1}, 2);
    mark_area(part, {8, 6, 1, 1}, 0);
    Image<Hit> hits(9, 7, Hit{.instance = 3});
    forget_others(part, hits);
    for (const auto [x, y] : all_pixels(9, 7)) {
        const bool inside = (x >= 3 && x <= 6 && y <= 2) || (x <= 2 && y >= 4) || (x == 8 && y == 6);
        EXPECT_EQ(part(x, y), inside ? 1 : 0) << x << " " << y;
        EXPECT_EQ(hits(x, y).instance, inside ? 3 : no_index);
    }
    EXPECT_DOUBLE_EQ(find_share(part), (4.0 * 3.0 + 3.0 * 3.0 + 1.0) / 63.0);
}

}  // namespace
}  // namespace aleph
