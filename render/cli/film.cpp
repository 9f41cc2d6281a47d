#include "render/cli/film.h"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <numeric>
#include <system_error>
#include <thread>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"
#include "render/cli/support/film_encoder.h"
#include "render/cli/support/film_program.h"
#include "render/cli/support/frame_claims.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/cli/watch.h"
#include "render/settings/frame_pattern.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr const char* encoder = "ffmpeg";
constexpr const char* lock_ending = ".lock";
constexpr std::int64_t fastest_gif = 50;  // frames a second: many players show delays below .02 s as .1 s

fs::path folder_of(const SceneOptions& options) {
    return fs::path(options.output).parent_path();
}

std::string describe_rate(const FrameRate& rate) {
    return rate.denominator == 1 ? std::to_string(rate.numerator)
                                 : fmt::format("{}/{}", rate.numerator, rate.denominator);
}

/// Puts a file in place of another; across file systems too, where that is a link.
void move_file(const fs::path& from, const fs::path& to) {
    remove_leftovers(to);  // by the one process that makes the film
    write_atomically(to, [&](const fs::path& temporary) {
        std::error_code error;
        fs::rename(from, temporary, error);
        if (error) fs::copy_file(from, temporary, fs::copy_options::overwrite_existing);
    });
}

FilmFrames list_frames(const FrameJob& job, const SceneOptions& options) {
    FilmFrames frames;
    const ClaimedOutput& output = job.claims.output();
    for (const int frame : output.frames) frames.files.push_back(output.file(frame));
    frames.rate = film_rate(options, output.frames, job.scene.film.frame_rate);
    frames.ending = lower_extension(options.film);
    frames.threads = find_threads(options.threads);
    return frames;
}

std::string describe_film(const SceneOptions& options, const FilmFrames& frames) {
    const PictureSize size = read_picture_size(frames.files.front());
    return fmt::format(
        "aleph: wrote {}: {} of {}x{}, {} a second{}\n", printable(options.film, 400),
        count_text(frames.files.size(), "frame"), size.width, size.height, describe_rate(frames.rate),
        is_padded(frames.ending, size) ? "; the last column or row stands twice, as sizes are even" : "");
}

/// @param check  called several times a second with the share that is done
void encode(const SceneOptions& options, const FilmFrames& frames, const std::string& fingerprint,
            const std::function<void(double done)>& check) {
    const fs::path made = folder_of(options) / ("film" + frames.ending);
    try {
        encode_film(find_program(encoder), made, frames, check);
        mark_film(made, frames.ending, fingerprint);
        move_file(made, options.film);
    } catch (const OutputError& e) {
        std::error_code ignored;
        fs::remove(made, ignored);
        throw OutputError(
            printable(options.film, 4096),
            fmt::format(
                "{}{}", e.what(),
                options.has_resume ? "; the frames are kept, and the same command with --resume makes the film" : ""));
    }
}

}  // namespace

FilmFolder::~FilmFolder() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove(folder_, ignored);
}

bool can_make_films() {
    return !find_program(encoder).empty();
}

FilmFolder choose_film(SceneOptions& options, const FrameRequest& request) {
    if (!names_film(options.output)) return FilmFolder();
    const fs::path film(options.output);
    if (find_number_field(film.filename().string(), "--output"))
        refuse_pattern(options.output, "a film has no frame number");
    if (request.frame && request.maps)
        refuse_pattern(options.output, "films cannot hold the channels of maps; write .exr");
    if (!can_make_films()) {
        throw OutputError(printable(options.output, 4096),
                          "films are made by the program ffmpeg, which is not in PATH: install it (Debian: apt-get "
                          "install ffmpeg), or write frames, such as name.####.png");
    }
    options.film = options.output;
    options.output = hidden_beside(film, "frames") / "frame.####.png";
    return FilmFolder(folder_of(options));
}

FrameRate film_rate(const SceneOptions& options, const std::vector<int>& frames, const FrameRate& scene) {
    const std::int64_t step = frames.size() > 1 ? std::int64_t{frames[1]} - frames[0] : 1;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (step > 0 && std::int64_t{frames[i]} - frames[i - 1] == step) continue;
        throw InputError(
            "", "--frames",
            fmt::format("frame {} follows frame {}: a film has frames at one distance, such as 1-100 or 1-100x2",
                        frames[i], frames[i - 1]));
    }
    const std::int64_t slower = std::gcd(scene.numerator, step), denominator = scene.denominator * (step / slower);
    const std::int64_t common = std::gcd(scene.numerator / slower, denominator);
    const FrameRate rate{scene.numerator / slower / common, denominator / common};
    if (lower_extension(options.film) == ".gif" && rate.numerator > fastest_gif * rate.denominator) {
        refuse_pattern(options.film,
                       fmt::format("a GIF has at most {} frames a second, the film {}; choose every second frame "
                                   "(--frames 1-100x2), or write .mp4",
                                   fastest_gif, describe_rate(rate)));
    }
    return rate;
}

std::string film_fingerprint(const SceneOptions& options, const std::vector<int>& frames, const FrameRate& scene,
                             const std::function<std::string(int frame)>& fingerprint) {
    std::string text = describe_rate(film_rate(options, frames, scene));
    for (const int frame : frames) text += "\n" + fingerprint(frame);
    return hash_bytes(text);
}

bool is_film_finished(const SceneOptions& options, const std::string& fingerprint) {
    return has_mark(options.film, lower_extension(options.film), fingerprint);
}

void remove_frames(const SceneOptions& options) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_of(options), error)) {
        if (entry.path().extension() != lock_ending) fs::remove(entry.path(), error);
    }
}

void finish_film(const FrameJob& job, const SceneOptions& options) {
    const std::string fingerprint = job.claims.output().identity;
    const RenderSignals signals;
    const auto stop_if_asked = [&] {
        if (options.watch != nullptr && options.watch->is_changed()) throw SceneChanged();
        signals.stop_if_asked(std::string(": all frames are finished, the film is not") +
                                  (options.has_resume ? "; the same command with --resume makes it" : ""),
                              options.resume);
    };
    const fs::path folder = folder_of(options);
    FrameLocks locks(folder / (std::string("film") + lock_ending), fingerprint);
    while (!locks.lock(0)) {
        stop_if_asked();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    if (options.resume && is_film_finished(options, fingerprint)) {
        remove_frames(options);
        if (!options.quiet) std::cerr << fmt::format("aleph: {} is finished\n", printable(options.film, 400));
        return;
    }
    const FilmFrames frames = list_frames(job, options);
    {
        Progress progress("film", 1.0, progress_look(options.quiet, options.progress));
        encode(options, frames, fingerprint, [&](double done) {
            stop_if_asked();
            progress.update(done, "ffmpeg");
        });
    }
    if (!options.quiet) std::cerr << describe_film(options, frames);
    remove_frames(options);
}

}  // namespace aleph
