// Beside the frames of a render: the --stats file, messages about copies, locks, and text in pictures.

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "render/cli/frame_writer.h"
#include "render/cli/support/frame_claims.h"
#include "render/cli/support/statistics_file.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

class StatisticsFileTest : public testing::Test {
  protected:
    StatisticsFileTest() { scene_.source.file = "a \"frames\": [] b.json"; }

    static FrameStatistics frame(int number) {
        FrameStatistics frame;
        frame.frame = number;
        frame.keyframes.resize(2);
        return frame;
    }
    std::string whole(const std::vector<int>& numbers, double exposure) const {
        std::vector<std::string> rows;
        for (const int number : numbers) rows.push_back(format_frame_statistics(frame(number)));
        return format_statistics(fmt::format("{}", fmt::join(rows, ",\n")), scene_, settings_, exposure);
    }
    std::vector<int> frames() const {
        const auto json = nlohmann::json::parse(read_bytes(path_));
        EXPECT_EQ(json.at("scene"), scene_.source.file);
        std::vector<int> frames;
        for (const auto& one : json.at("frames")) frames.push_back(one.at("frame"));
        return frames;
    }

    Scene scene_;
    RenderSettings settings_;
    const ScratchFolder folder_;
    const fs::path path_ = folder_ / "statistics.json";
};

TEST_F(StatisticsFileTest, HasTheFirstFrameAtOnceAndAllAtTheEnd) {
    StatisticsFile file(path_, scene_, settings_, 2.0);
    file.add(0, frame(7), "");
    EXPECT_EQ(frames(), std::vector<int>{7});
    file.add(1, frame(8), "");
    EXPECT_EQ(frames().front(), 7);
    file.add(2, frame(9), "");
    file.finish();
    EXPECT_EQ(frames(), (std::vector<int>{7, 8, 9}));
    EXPECT_EQ(read_bytes(path_), whole({7, 8, 9}, 2.0));
}

/// As where all frames were finished before, without statistics.
TEST_F(StatisticsFileTest, IsThereWithoutFrames) {
    std::ofstream(path_) << "of another render";
    StatisticsFile file(path_, scene_, settings_, 1.0);
    file.finish();
    EXPECT_EQ(frames(), std::vector<int>{});
}

TEST_F(StatisticsFileTest, HasTheFinishedFramesAfterAnError) {
    try {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        for (const int number : {1, 2, 3}) file.add(number, frame(number), "");
        throw std::runtime_error("the fourth frame");
    } catch (const std::runtime_error&) {
        EXPECT_EQ(frames(), (std::vector<int>{1, 2, 3}));
    }
}

/// A run that is stopped has not come to all frames of the runs before it.
TEST_F(StatisticsFileTest, RowsOfFramesThatDidNotComeUpSurviveAStop) {
    {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        for (const int number : {5, 6}) file.add(number, frame(number), fmt::format("print {}", number));
        file.finish();
    }
    {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        EXPECT_EQ(file.take_over().size(), 2u);
        file.add(0, frame(1), "print 1");
        EXPECT_EQ(read_statistics_rows(path_).size(), 3u) << "as after a kill";
    }
    EXPECT_EQ(read_statistics_rows(path_).size(), 3u) << "after a stop";
}

TEST_F(StatisticsFileTest, RowsAreNotedOnceHoweverOftenRunsAreStopped) {
    const fs::path rows = folder_ / ".statistics.json.rows";
    {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        file.add(0, frame(1), "one");
    }
    const std::string noted = read_bytes(rows);
    for (int run = 0; run < 3; ++run) {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        file.keep(0, file.take_over().at("one"));
    }
    EXPECT_EQ(read_bytes(rows), noted);
    EXPECT_EQ(frames(), std::vector<int>{1});
}

TEST_F(StatisticsFileTest, RowsOfFinishedFramesSurvive) {
    const fs::path rows = folder_ / ".statistics.json.rows";
    {
        StatisticsFile file(path_, scene_, settings_, 1.0);
        file.note(frame(1), "one");
        file.add(0, frame(1), "one");
        file.note(frame(2), "two");  // and then the process is killed
        std::ofstream(rows, std::ios::app) << "\n{\"frame\": 3, \"finger";
        file.note(frame(4), "four");
    }
    EXPECT_TRUE(fs::exists(rows)) << "until all frames are there";
    EXPECT_EQ(read_statistics_rows(path_).size(), 3u);
    StatisticsFile file(path_, scene_, settings_, 1.0);
    file.note(frame(2), "two");
    std::ofstream(rows, std::ios::app) << "\n{\"frame\": 3, \"finger";
    file.note(frame(4), "four");
    const auto kept = read_statistics_rows(path_);
    ASSERT_EQ(kept.size(), 3u);
    file.keep(2, kept.at("four"));
    file.keep(0, kept.at("one"));
    file.add(1, frame(2), "two");
    file.finish();
    EXPECT_FALSE(fs::exists(rows));
    EXPECT_EQ(frames(), (std::vector<int>{1, 2, 4}));
    EXPECT_EQ(kept.at("four"), format_frame_statistics(frame(4), "four"));
    EXPECT_TRUE(read_statistics_rows(folder_ / "no such file").empty());
    std::ofstream(path_) << "no JSON";
    EXPECT_TRUE(read_statistics_rows(path_).empty());
}

TEST_F(StatisticsFileTest, WhatIsNestedVeryDeepIsLeftOut) {
    constexpr std::size_t depth = 4000;
    const std::string deep = std::string(depth, '[') + std::string(depth, ']');
    std::ofstream(path_) << R"({"frames": [{"fingerprint": "one", "frame": 1, "deep": )" << deep << "}]}";
    const std::string row = read_statistics_rows(path_).at("one");
    EXPECT_LT(row.size(), 4 * depth) << "its indentation alone would be " << depth * depth;
    EXPECT_EQ(nlohmann::json::parse(row).at("frame"), 1);
}

TEST_F(StatisticsFileTest, LooksLikeAnyOtherJson) {
    for (const std::vector<int>& list : {{}, {1}, std::vector{1, -2}}) {
        const std::string text = whole(list, 1.0);
        const auto json = nlohmann::ordered_json::parse(text);
        EXPECT_EQ(json.at("frames").size(), list.size());
        EXPECT_EQ(text, json.dump(2) + "\n");
    }
}

TEST(StatisticsFile, WritingTakesATenthOfTheTime) {
    EXPECT_TRUE(is_write_due(0.0, 0.0)) << "nothing is written yet";
    EXPECT_FALSE(is_write_due(0.09, 0.01));
    EXPECT_TRUE(is_write_due(0.11, 0.01));
}

TEST(CopiedFrames, AreSaidOncePerHold) {
    std::vector<FinishedFrame> list(20);
    for (std::size_t i = 0; i < list.size(); ++i) list[i].frame = static_cast<std::int64_t>(i);
    EXPECT_EQ(describe_copies(list), "");
    list[2].copy_of = list[3].copy_of = list[4].copy_of = 1;
    list[8].copy_of = 7;
    const std::string two =
        "aleph: frames 2-4 are copies of frame 1: nothing changes\n"
        "aleph: frame 8 is a copy of frame 7: nothing changes\n";
    EXPECT_EQ(describe_copies(list), two);
    for (const int frame : {11, 13, 15, 16, 18}) list[frame].copy_of = frame == 16 ? 14 : frame - 1;
    EXPECT_EQ(describe_copies(list), two +
                                         "aleph: frame 11 is a copy of frame 10: nothing changes\n"
                                         "aleph: frame 13 is a copy of frame 12: nothing changes\n"
                                         "aleph: 3 more frames are copies of others\n");
}

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
