// Locks on frames, and text beside the pixels of pictures.

#include "render/cli/support/frame_locks.h"
#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

TEST(FrameLocks, OneAtATimeHasAFrame) {
    const ScratchFolder folder;
    const fs::path file = folder / ".f.lock";
    {
        FrameLocks one(file, "pool"), other(file, "pool");
        EXPECT_TRUE(one.lock(-7));
        EXPECT_TRUE(one.lock(-7)) << "again by the same";
        EXPECT_FALSE(other.lock(-7));
        EXPECT_TRUE(other.lock(2000000000));
        EXPECT_FALSE(one.lock(2000000000));
        one.unlock(-7);
        EXPECT_TRUE(other.lock(-7));
        EXPECT_THROW(FrameLocks(file, "cornell"), OutputError);
    }
    EXPECT_FALSE(fs::exists(file)) << "the last one removes it";
    FrameLocks again(file, "cornell");
    EXPECT_TRUE(again.lock(-7));
}

TEST(FrameLocks, AFileThatAKilledProcessLeftIsTakenOver) {
    const ScratchFolder folder;
    std::ofstream(folder / ".f.lock") << "something else";
    FrameLocks locks(folder / ".f.lock", "pool");
    EXPECT_TRUE(locks.lock(1));
    EXPECT_EQ(read_bytes(folder / ".f.lock"), "pool");
}

TEST(PictureText, IsReadFromWholeFilesOnly) {
    const ScratchFolder folder;
    ChannelImage exr;
    for (const char* name : {"R", "G", "B"}) exr.channels.push_back({name, Image<float>(40, 30, 0.25f)});
    exr.metadata["a:key"] = std::string("some text");
    write_exr(folder / "a.exr", exr);
    Image<Rgb> picture(40, 30, Rgb(0.5f));
    for (std::size_t i = 0; i < picture.size(); ++i) picture.pixels[i].x = static_cast<float>(i % 7) / 7.0f;
    const PictureTexts texts{{"a:key", "some text"}};
    write_png(folder / "a.png", picture, texts);
    for (const std::string ending : {"exr", "png"}) {
        SCOPED_TRACE(ending);
        const fs::path file = folder / ("a." + ending), cut = folder / ("cut." + ending);
        EXPECT_EQ(read_picture_text(file, "a:key"), "some text");
        EXPECT_EQ(read_picture_text(file, "key"), std::nullopt);
        EXPECT_EQ(read_image(file).channels.size(), 3u);
        const std::string bytes = read_bytes(file);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            std::ofstream(cut, std::ios::binary) << bytes.substr(0, size);
            EXPECT_EQ(read_picture_text(cut, "a:key"), std::nullopt) << size << " of " << bytes.size();
        }
        EXPECT_EQ(read_picture_text(folder / ("none." + ending), "a:key"), std::nullopt);
    }
    std::ofstream(folder / "text.exr") << "some text";
    EXPECT_EQ(read_picture_text(folder / "text.exr", "a:key"), std::nullopt);
}

}  // namespace
}  // namespace aleph
