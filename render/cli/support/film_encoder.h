#pragma once
// PNG files to a film, by the program ffmpeg.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "render/settings/setting_table.h"

namespace aleph {

/// Frames and how they become a film.
struct FilmFrames {
    std::vector<std::filesystem::path> files;  ///< PNG, all of one size, in the order of the film
    FrameRate rate;
    std::string ending;  ///< ".mp4", ".mov", ".webm", ".gif"
    int threads = 0;     ///< of the encoder; 0: its choice
};

PictureSize read_picture_size(const std::filesystem::path& file);

/// Returns whether a film of this size has one more column or row, as its pixels are stored: H.264 and VP9 hold
/// colours for squares of 2 x 2 pixels.
bool is_padded(const std::string& ending, const PictureSize& size);

/// Writes the film. mp4, mov: H.264; webm: VP9; both YCbCr 4:2:0 with the tags of BT.709. gif: one palette for all
/// frames, endless. Where the size is odd, the last column or row stands twice.
/// @param ffmpeg  the program
/// @param film    written in place; for a gif `film`.palette beside it
/// @param check   called several times a second with the share that is done; what it throws ends ffmpeg
/// @throws OutputError naming ffmpeg, with the last of what it printed
void encode_film(const std::filesystem::path& ffmpeg, const std::filesystem::path& film, const FilmFrames& frames,
                 const std::function<void(double done)>& check);

/// Marks a film as made from what a fingerprint names: behind its last byte (mp4, mov: a box "free"; webm: an element
/// Void), or as a comment (gif). Players do not look at any of them.
/// @throws OutputError
void mark_film(const std::filesystem::path& film, const std::string& ending, const std::string& fingerprint);

/// Returns whether the film is there, is not cut, and has that mark.
bool has_mark(const std::filesystem::path& film, const std::string& ending, const std::string& fingerprint);

}  // namespace aleph
