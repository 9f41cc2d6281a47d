#pragma once
// Films in tests: what ffmpeg and ffprobe find in them, and programs in place of ffmpeg.

#include <cstdio>
#include <cstdlib>

#include "engine/image/image_file.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {

/// The text that a command prints on standard output. @param command  of the shell
inline std::string output_of(const std::string& command) {
    FILE* const stream = ::popen(command.c_str(), "r");
    std::string text;
    char buffer[4096];
    for (std::size_t size = 0; (size = ::fread(buffer, 1, sizeof buffer, stream)) > 0;) text.append(buffer, size);
    EXPECT_EQ(::pclose(stream), 0) << command;
    return text;
}

/// "width,height,rate,frames" and more of a film's only stream. @param entries  names of ffprobe, in its order
inline std::string probe_film(const std::filesystem::path& film, const std::string& entries) {
    std::string text = output_of(
        fmt::format("ffprobe -v error -count_frames -show_entries stream={} -of csv=p=0 '{}'", entries, film.string()));
    while (!text.empty() && (text.back() == '\n' || text.back() == ',')) text.pop_back();
    return text;
}

/// The pictures of a film as PNG files, decoded.
inline std::vector<ChannelImage> decode_film(const std::filesystem::path& film) {
    const ScratchFolder folder;
    output_of(fmt::format("ffmpeg -v error -i '{}' -vsync passthrough -vf scale=in_color_matrix=bt709 '{}/%04d.png'",
                          film.string(), folder.path().string()));
    std::vector<ChannelImage> frames;
    for (int i = 1; std::filesystem::exists(folder / fmt::format("{:04}.png", i)); ++i)
        frames.push_back(read_image(folder / fmt::format("{:04}.png", i)));
    return frames;
}

/// Mean of one channel over a part of a picture, in steps of 8-bit values.
struct PicturePartMeans {
    int left = 0, right = 0, top = 0, bottom = 0;  ///< pixels; the ends are outside

    double mean(const ChannelImage& image, const char* channel) const {
        double sum = 0.0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) sum += (*image.find(channel))(x, y);
        return 255.0 * sum / ((right - left) * (bottom - top));
    }
};

/// Expects the means of all channels to be equal within 2 of 255, and those over blocks of 8 x 8 pixels within
/// `tolerance`: films keep colours at half the resolution, so that some crosses the edges of blocks.
inline void expect_alike(const ChannelImage& found, const ChannelImage& expected, double tolerance) {
    const int width = expected.find("R")->width, height = expected.find("R")->height;
    ASSERT_GE(found.find("R")->width, width);
    ASSERT_GE(found.find("R")->height, height);
    for (const char* channel : {"R", "G", "B"}) {
        const PicturePartMeans whole{0, width, 0, height};
        EXPECT_NEAR(whole.mean(found, channel), whole.mean(expected, channel), 2.0) << channel;
        for (int y = 0; y + 8 <= height; y += 8) {
            for (int x = 0; x + 8 <= width; x += 8) {
                const PicturePartMeans part{x, x + 8, y, y + 8};
                ASSERT_NEAR(part.mean(found, channel), part.mean(expected, channel), tolerance)
                    << channel << " at " << x << ", " << y;
            }
        }
    }
}

/// PATH with one folder, or another one, until the end of the scope.
class ScopedPath {
  public:
    explicit ScopedPath(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
    ~ScopedPath() { ::setenv("PATH", before_.c_str(), 1); }
    ScopedPath(const ScopedPath&) = delete;
    ScopedPath& operator=(const ScopedPath&) = delete;

    const std::string& before() const { return before_; }

  private:
    std::string before_;
};

/// A program `ffmpeg` that is a script. @param body  of sh
inline void write_fake_ffmpeg(const std::filesystem::path& folder, const std::string& body) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
}

}  // namespace aleph
