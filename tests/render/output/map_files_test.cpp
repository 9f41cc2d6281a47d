// Maps for other programs: motion as a .flo file, importance as one picture.

#include <gtest/gtest.h>

#include <cstring>

#include "render/output/flow_file.h"
#include "render/output/frame_files.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

TEST(FlowFile, HoldsDisplacementsRowByRowAndMarksWhatIsNotKnown) {
    MotionField motion;
    motion.displacement = Image<glm::dvec2>(3, 2, glm::dvec2(0.0));
    motion.validity = Image<MotionValidity>(3, 2, MotionValidity::valid);
    motion.displacement(2, 0) = {1.5, -2.25};
    motion.displacement(0, 1) = {-3.0, 4.0};
    motion.validity(0, 1) = MotionValidity::hidden;
    motion.validity(1, 1) = MotionValidity::no_counterpart;
    motion.validity(2, 1) = MotionValidity::behind_camera;
    const ScratchFolder folder;
    write_flow(folder.path() / "motion.flo", motion);
    const auto bytes = read_bytes(folder.path() / "motion.flo");
    ASSERT_EQ(bytes.size(), 12u + 6u * 8u);
    float tag = 0.0f;
    std::memcpy(&tag, bytes.data(), 4);
    EXPECT_EQ(tag, 202021.25f) << "the format's check of the byte order";
    std::int32_t size[2];
    std::memcpy(size, bytes.data() + 4, 8);
    EXPECT_EQ(size[0], 3);
    EXPECT_EQ(size[1], 2);
    float flow[12];
    std::memcpy(flow, bytes.data() + 12, sizeof flow);
    EXPECT_EQ(flow[0], 0.0f);
    EXPECT_EQ(flow[4], 1.5f);
    EXPECT_EQ(flow[5], -2.25f) << "y down";
    EXPECT_EQ(flow[6], -3.0f) << "hidden there, but known";
    EXPECT_EQ(flow[7], 4.0f);
    for (int i = 8; i < 12; ++i) EXPECT_GT(flow[i], 1e9f) << "unknown";
}

TEST(Importance, IsOneWhereViewersAreStrictest) {
    Image<float> aleph(3, 1);
    aleph.pixels = {1.0f, 4.0f, 250.6f};
    const Image<float> importance = make_importance(aleph);
    EXPECT_EQ(importance.pixels, (std::vector<float>{1.0f, 0.25f, 1.0f / 250.6f}));
}

}  // namespace
}  // namespace aleph
