// `aleph preview`: the whole shot, small and coarse, as a film and as a sheet of frames.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "render/cli/commands.h"
#include "render/cli/film.h"
#include "render/cli/support/options.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/cli/watch.h"
#include "render/cli/write_frames.h"
#include "render/output/sheet.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr int longest_side = 240;        // pixels
constexpr std::size_t most_frames = 60;  // of the film
constexpr std::size_t sheet_frames = 12, sheet_columns = 4;

constexpr const char* preview_footer =
    "Each frame is the quick estimate of the renderer, without noise: direct light with soft shadows, coarse "
    "indirect light, mirrors and glass; gloss shows lamps alone, and motion blur comes in steps. The film has at most "
    "60 frames, evenly spread over the shot, and lasts as long as the shot. The sheet (PNG, beside the film) has up to "
    "12 of them with their numbers.\n\n"
    "Examples:\n"
    "  aleph preview scenes/pool/scene.json                            pool.preview.mp4 and pool.preview.png\n"
    "  aleph preview scenes/pool/scene.json --motion -o motion.mp4     with lines of motion\n"
    "  aleph preview scenes/pool/scene.json -o pool.png --watch        the sheet alone, while the scene is edited";

struct PreviewOptions {
    SceneOptions scene;
    std::string size;
    bool motion = false;
    WatchOptions watch;
};

/// The same shape, with sides of at most longest_side pixels.
void shrink(PictureSettings& picture) {
    const int longest = std::max(picture.width, picture.height);
    if (longest <= longest_side) return;
    const auto shrunk = [&](int side) {
        return std::max(2, 2 * static_cast<int>(std::lround(0.5 * side * longest_side / longest)));
    };
    picture.width = shrunk(picture.width);
    picture.height = shrunk(picture.height);
}

/// Every n-th, so that at most `most` are left.
std::vector<int> thin_out(const std::vector<int>& frames, std::size_t most) {
    const std::size_t step = (frames.size() + most - 1) / most;
    std::vector<int> left;
    for (std::size_t i = 0; i < frames.size(); i += step) left.push_back(frames[i]);
    return left;
}

/// Indirect light is computed at every fourth frame of the preview, and interpolated.
void spread_light(CacheSettings& cache, const std::vector<int>& frames) {
    constexpr std::int64_t most = 1000;  // of the setting
    const std::int64_t step = frames.size() > 1 ? std::abs(std::int64_t{frames[1]} - frames[0]) : 1;
    cache.light_step = static_cast<int>(std::min(4 * step, most));
}

/// At most sheet_frames of them, evenly spread, the first and the last among them.
std::vector<int> choose_for_sheet(const std::vector<int>& frames) {
    const std::size_t count = std::min(frames.size(), sheet_frames);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)]);
    return chosen;
}

struct PreviewFiles {
    std::string film;  ///< empty: none
    fs::path sheet;
};

/// @throws InputError (--output)
PreviewFiles choose_files(const std::string& output, const std::string& name, bool quiet) {
    if (names_film(output)) return {output, fs::path(output).replace_extension(".png")};
    if (!output.empty()) {
        if (lower_extension(output) == ".png") return {"", output};
        throw InputError("", "--output",
                         fmt::format("'{}': a preview is a film, .mp4, .mov, .webm or .gif, with a sheet of frames "
                                     "beside it, or that sheet alone, .png",
                                     printable(output, 400)));
    }
    PreviewFiles files{name + ".preview.mp4", name + ".preview.png"};
    if (can_make_films()) return files;
    if (!quiet) {
        std::cerr << "aleph: warning: the sheet of frames is made, and no film: films are made by the program ffmpeg, "
                     "which is not in PATH (Debian: apt-get install ffmpeg)\n";
    }
    files.film.clear();
    return files;
}

/// The quick estimates of a scene, and those of them that the sheet shows.
class PreviewFrames {
  public:
    PreviewFrames(PreparedScene& prepared, const std::string& camera, bool motion)
        : sequence_(std::move(prepared.scene), prepared.settings, camera), motion_(motion) {
        for (const int frame : choose_for_sheet(prepared.frames)) panels_[frame];
    }

    const Sequence& sequence() const { return sequence_; }

    /// A frame whose picture is the estimate.
    FrameOutput make(int frame, const FrameRequest& request) {
        FrameOutput output = sequence_.render(frame, request);
        output.shaded.color = output.estimate;
        if (motion_) draw_motion(output.shaded.color, output.motion);
        const auto panel = panels_.find(frame);
        if (panel != panels_.end()) panel->second = color_panel(fmt::format("frame {}", frame), output.shaded.color);
        return output;
    }

    void write(const fs::path& file) const {
        std::vector<Panel> panels;
        for (const auto& [frame, panel] : panels_) panels.push_back(panel);
        const std::size_t columns = std::min(sheet_columns, panels.size());
        write_sheet(file, panels, static_cast<int>(columns), panels.front().display.width);
    }

  private:
    Sequence sequence_;
    const bool motion_;
    std::map<int, Panel> panels_;
};

const FrameRequest preview_request{.frame = false, .maps = true, .progress = {}};

PreviewFrames make_film(PreparedScene& prepared, const SceneOptions& options, bool motion) {
    prepare_frames_output(prepared, options, preview_request);
    const FramePrints prints = fingerprint_frames(prepared, options, preview_request);
    FrameClaims claims = claim_frames(prepared, options, prints);
    PreviewFrames frames(prepared, options.camera, motion);
    const auto make = [&](int frame, const FrameRequest& asked) { return frames.make(frame, asked); };
    FrameJob job{frames.sequence().scene(), prepared.settings, frames.sequence().exposure(), make, claims};
    job.title = "preview";
    try {
        write_frames(job, options, preview_request);
    } catch (...) {
        remove_frames(options);  // nothing goes on with them
        throw;
    }
    return frames;
}

PreviewFrames make_sheet_alone(PreparedScene& prepared, const SceneOptions& options, bool motion) {
    prepared.frames = choose_for_sheet(prepared.frames);
    PreviewFrames frames(prepared, options.camera, motion);
    Progress progress("preview", static_cast<double>(prepared.frames.size()),
                      progress_look(options.quiet, options.progress));
    FrameRequest request = preview_request;
    const RenderSignals signals;
    request.progress = [&](double, const char*) {
        signals.stop_if_asked();
        if (options.watch != nullptr && options.watch->is_changed()) throw SceneChanged();
    };
    double done = 0.0;
    for (const int frame : prepared.frames) {
        frames.make(frame, request);
        progress.update(++done, fmt::format("frame {}", frame));
    }
    return frames;
}

void preview_once(const PreviewOptions& given) {
    SceneOptions options = given.scene;
    options.has_resume = false;
    if (!given.size.empty()) options.settings["size"] = given.size;
    PreparedScene prepared = prepare_scene(options);
    const PreviewFiles files = choose_files(options.output, prepared.name, options.quiet);
    options.output = files.film;
    const FilmFolder folder = choose_film(options, preview_request);
    refuse_overwriting(prepared.read, {{files.sheet, "--output"}});
    try_output(files.sheet);
    if (given.size.empty()) shrink(prepared.settings.picture);
    const std::size_t all = prepared.frames.size();
    prepared.frames = thin_out(prepared.frames, most_frames);
    spread_light(prepared.settings.cache, prepared.frames);
    if (!options.quiet && prepared.frames.size() < all)
        std::cerr << fmt::format("aleph: preview of {} of {} frames\n", prepared.frames.size(), all);
    const ThreadLimit limit(find_threads(options.threads));
    const PreviewFrames frames = options.film.empty() ? make_sheet_alone(prepared, options, given.motion)
                                                      : make_film(prepared, options, given.motion);
    frames.write(files.sheet);
    if (options.watch != nullptr) options.watch->show(files.sheet);
    if (!options.quiet) std::cerr << fmt::format("aleph: wrote {}\n", printable(files.sheet.string(), 400));
}

}  // namespace

void add_preview_command(CLI::App& app, Command& command) {
    CLI::App* preview = app.add_subcommand("preview", "show a whole shot, small and coarse, in seconds");
    const auto options = std::make_shared<PreviewOptions>();
    add_shot_options(*preview, options->scene,
                     "the film, name.mp4, .mov, .webm or .gif, made by the program ffmpeg, with the sheet name.png "
                     "beside it; or name.png, the sheet alone; default: SCENE.preview.mp4");
    add_text(
        *preview, "--size", "WIDTHxHEIGHT", options->size,
        fmt::format("size of the frames; default: the scene's shape, with sides of at most {} pixels", longest_side));
    preview->add_flag("--motion", options->motion,
                      fmt::format("draw lines of motion: from points of the picture, marked red, to where they are {} "
                                  "frames later at their present speed",
                                  motion_line_frames));
    add_watch_options(*preview, options->watch);
    preview->footer(preview_footer);
    preview->callback([options, &command] {
        command = [options] {
            run_maybe_watched(options->watch, options->scene, [&] { preview_once(*options); });
            return exit_done;
        };
    });
}

}  // namespace aleph
