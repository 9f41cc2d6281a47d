#pragma once
// Runs `aleph maps` on pictures of a texture that moves.

#include "engine/image/image_file.h"
#include "render/output/frame_files.h"
#include "render/settings/frame_pattern.h"
#include "tests/render/cli/answers.h"
#include "tests/support/image_patterns.h"

namespace aleph {

inline Ran run_maps(const std::vector<std::string>& arguments) {
    return run_command({"maps", "-q"}, arguments);
}

inline constexpr int width = 72, height = 56;

/// A texture that moves by (4, 8) pixels a frame, y down.
inline Image<Rgb> picture(int frame) {
    return make_pattern(width, height,
                        [&](int x, int y) { return smooth_texture(x - 4.0 * frame, y - 8.0 * frame, 10.0); });
}

/// A folder with frames f.0001.exr and so on.
struct Frames {
    ScratchFolder folder;
    Frames(int first, int last) {
        for (int frame = first; frame <= last; ++frame) write(frame, picture(frame));
    }
    std::filesystem::path file(int frame) const { return folder / insert_number("f.####.exr", {2, 4, 4}, frame); }
    void write(int frame, const Image<Rgb>& image) const { write_exr(file(frame), make_color_image(image)); }
    std::string pattern() const { return (folder / "f.####.exr").string(); }
    std::string out() const { return (folder / "out").string(); }
    /// Runs `aleph maps` on all of them, into the folder `out`.
    Ran run(const Words& more = {}) const { return run_maps(joined({"--images", pattern(), "-o", out()}, more)); }
    ChannelImage maps(int frame) const {
        return read_image(folder.path() / "out" / insert_number("f-maps.####.exr", {7, 4, 4}, frame));
    }
};

}  // namespace aleph
