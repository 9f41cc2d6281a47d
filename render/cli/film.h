#pragma once
// Frames as a film (-o film.mp4): PNG files in a hidden folder beside it, which the program ffmpeg makes the film from.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/cli/frame_writer.h"
#include "render/cli/scene_options.h"

namespace aleph {

/// The hidden folder of the frames, `.film.mp4.frames`. At the end of the scope it is removed if nothing is in it.
class FilmFolder {
  public:
    explicit FilmFolder(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}
    ~FilmFolder();
    FilmFolder(const FilmFolder&) = delete;
    FilmFolder& operator=(const FilmFolder&) = delete;

  private:
    std::filesystem::path folder_;
};

/// Returns whether the program that makes films can be found.
bool can_make_films();

/// Where --output names a film, it is moved to `options.film`, and --output becomes the files of the frames. Does
/// nothing otherwise.
/// @param request  what the frames are to hold
/// @throws InputError (--output) if the name has a number, or for the channels of --aovs; OutputError if there is no
/// ffmpeg
[[nodiscard]] FilmFolder choose_film(SceneOptions& options, const FrameRequest& request);

/// Frames a second of a film of these frames: every second frame gives half the scene's rate, so that the film lasts as
/// long as the shot.
/// @throws InputError (--frames) if they do not follow each other at one distance; (--output) beyond what a GIF holds
FrameRate film_rate(const SceneOptions& options, const std::vector<int>& frames, const FrameRate& scene);

/// The fingerprints of all frames in one, and of their rate.
std::string film_fingerprint(const SceneOptions& options, const std::vector<int>& frames, const FrameRate& scene,
                             const std::function<std::string(int frame)>& fingerprint);

/// Returns whether options.film is there, whole, and has the fingerprint.
bool is_film_finished(const SceneOptions& options, const std::string& fingerprint);

/// Removes the frames of the film, and what is left of others that were never made a film.
void remove_frames(const SceneOptions& options);

/// Encodes the film of frames that are all there, unless it is finished, and removes the frames. Of several processes
/// that made the frames, one encodes and the others wait.
/// @throws OutputError; Stopped after a signal. The frames are kept then, and --resume goes on with them.
void finish_film(const FrameJob& job, const SceneOptions& options);

}  // namespace aleph
