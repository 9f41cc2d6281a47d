// `aleph maps --images`: the files that a pattern names, and the frame that each is compared with.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/errors.h"
#include "render/cli/frame_pattern.h"
#include "render/images/image_sequence.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

TEST(MapsImages, FindsFilesByPattern) {
    const ScratchFolder folder;
    for (const char* name : {"f.0001.exr", "f.0010.exr", "f.-003.exr", "f.12345.exr", "f.00011.exr", "f.1.exr",
                             "f.0002.exr.part", "g.0001.exr", "f.x.exr", "f..exr"}) {
        std::ofstream(folder / name) << "x";
    }
    std::vector<std::int64_t> numbers;
    for (const auto& [number, path] : find_frame_files((folder / "f.####.exr").string())) {
        numbers.push_back(number);
        EXPECT_TRUE(fs::exists(path));
    }
    EXPECT_EQ(numbers, (std::vector<std::int64_t>{-3, 1, 10, 12345}));
    EXPECT_EQ(find_frame_files((folder / "f.%d.exr").string()).size(), 2u);  // 1 and 12345
}

TEST(MapsImages, TheOtherFrameOfAFrame) {
    FrameFiles files;
    for (const int frame : {1, 2, 3, 10, 11}) files[frame] = "f";
    const std::vector<std::int64_t> cuts = {10};
    EXPECT_EQ(find_other_frame(files, cuts, 1), OtherFrame::next);
    EXPECT_EQ(find_other_frame(files, cuts, 3), OtherFrame::none);
    EXPECT_EQ(find_other_frame(files, cuts, 11), OtherFrame::previous);
    EXPECT_THROW(find_other_frame(files, {}, 3), InputError);
    EXPECT_THROW(find_other_frame(files, cuts, 4), InputError);
    EXPECT_THROW(find_other_frame({}, cuts, 4), InputError);
    EXPECT_EQ(find_other_frame({{5, "f"}}, {}, 5), OtherFrame::none);
}

}  // namespace
}  // namespace aleph
