// `aleph render`: renders frames of a scene, with an accuracy that follows their Aleph maps.

#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/budget.h"
#include "render/cli/commands.h"
#include "render/cli/film.h"
#include "render/cli/support/options.h"
#include "render/cli/watch.h"
#include "render/cli/write_frames.h"

namespace aleph {

namespace {

constexpr const char* render_footer =
    "--error is the largest error, in differences that a viewer just sees; without any of --error, --accuracy, "
    "--gather, --spp, --sampling, --light-samples and --integrator it is 1. It chooses accuracy, gather rays, bounces "
    "and samples; options given beside it override them. Afterwards the program prints what share of the pixels it "
    "expects to err by more; --aovs has the error of every pixel and its causes.\n"
    "--budget measures a part of up to three frames first. The error it chooses is printed and stored in the "
    "statistics (--stats): --error with that number makes the same bytes again. The time is an estimate.\n"
    "--verify measures what the estimate says: blocks of 16 pixels, the same ones whenever the same frames are "
    "rendered, against path traced references, as a viewer sees the frames around them. -q does not silence it.\n"
    "--accuracy is the error that irradiance caching may make where the viewer is strictest. Elsewhere the Aleph map "
    "allows more, which saves time; with --guide none the accuracy is the same everywhere.\n"
    "Without --error indirect light is computed at lighting keyframes, every --light-step frames, at both sides of a "
    "cut and at the last frame; frames between two of them interpolate. A frame rendered alone takes two of them and "
    "their middle, a sequence two more for each step. --error computes few records for every frame instead, and "
    "--integrator path none. For a long shot, and for a --cache file, give --light-step 10 beside --error: most shots "
    "take less time and flicker less, but a frame alone takes two to three times as long.\n"
    "--resume goes on where a render was stopped, by SIGTERM, SIGINT or anything else: each file has the fingerprint "
    "of what it was made from, and one that is damaged or of something else is made again. SIGTERM and SIGINT then "
    "exit with 75, without --resume with 143 and 130. SIGUSR1 prints a line and writes the picture so far "
    "(NAME.partial.EXT, until the frame is finished). The rows of --stats and the light of --cache are kept.\n"
    "A film (-o film.mp4, .mov, .webm, .gif) is made by the program ffmpeg from PNG files in a hidden folder, "
    ".film.mp4.frames, which is removed then; after a stop --resume goes on with them. The film has the scene's frame "
    "rate, or half of it with every second frame (--frames 1-99x2). .mp4 and .mov hold H.264, .webm VP9, all of them "
    "YCbCr 4:2:0 with the tags of BT.709, so that the last column or row of an odd size stands twice; .gif has one "
    "palette.\n"
    "--watch renders again whenever the scene or a file that it uses changes, also while frames are made, until "
    "Ctrl-C.\n"
    "The file has the channels R, G, B and A. `aleph maps --help` describes those that --aovs adds.\n\n"
    "Examples:\n"
    "  aleph render scenes/pool/scene.json --frames 20 -o frame.exr                  no visible error\n"
    "  aleph render scenes/pool/scene.json --frames 20 --spp 1 -o frame.png          a quick look\n"
    "  aleph render scenes/pool/scene.json --budget 600 -o out/                      the whole shot in ten minutes\n"
    "  aleph render scenes/pool/scene.json --error 1 --verify 60 -o out/             and how much is really seen\n"
    "  aleph render scenes/pool/scene.json -o out/ --stats out/stats.json            the whole shot\n"
    "  aleph render scenes/pool/scene.json -o out/ --stats out/stats.json --resume   go on after a stop\n"
    "  aleph render scenes/pool/scene.json -o out/ --resume --time-limit 3600        an hour of it at a time\n"
    "  aleph render scenes/pool/scene.json -o pool.mp4 --resume                      a film\n"
    "  aleph render scenes/pool/scene.json --frames 20 --spp 1 -o frame.png --watch  while the scene is edited\n"
    "  aleph render scenes/pool/scene.json --frames 20 --guide none --spp 16 -o unguided.exr  the baseline\n"
    "  aleph render scenes/pool/scene.json --frames 20 --accuracy 0 --gather 4096 --spp 1 -o dense.exr";

/// @throws InputError for frames that are path traced, as the references are that would judge them
void refuse_traced(const RenderSettings& settings) {
    if (settings.light.integrator != Integrator::path) return;
    throw InputError("--verify", "--integrator path",
                     "give one of the two: frames are judged by traced paths, which tell nothing of their like; "
                     "variance.Y of the files has the noise of each pixel");
}

struct RenderOptions {
    SceneOptions scene;
    bool aovs = false;
    WatchOptions watch;
    std::string cache;
    std::optional<std::string> budget, verify;
};

/// @throws InputError for two options of which one could not have its way
void refuse_contradictions(const RenderOptions& options) {
    const SceneOptions& scene = options.scene;
    const auto refuse = [](bool both, const char* option, const std::string& other, const char* reason) {
        if (both) throw InputError(option, other, reason);
    };
    const auto refuse_beside_resume = [&](bool given, const char* reason) {
        refuse(scene.resume && given, "", "--resume", reason);
    };
    const bool crop = !scene.crop.empty(), verify = options.verify.has_value(), budget = options.budget.has_value();
    refuse_beside_resume(budget,
                         "--budget may choose another error than before; give --error with the number that it chose");
    refuse_beside_resume(verify, "--verify checks the frames that it renders; render all of them with it");
    refuse_beside_resume(scene.strict, "files of frames do not tell what --strict asks; render all of them with it");
    refuse(budget && crop, "--budget", "--crop", "give one of the two: a budget is for whole pictures");
    refuse(verify && crop, "--verify", "--crop", "give one of the two: blocks are judged with what is around them");
    for (const char* const key : {"error", "spp", "sampling", "gather", "accuracy"}) {
        refuse(budget && scene.settings.contains(key), "--budget", std::string("--") + key,
               "give one of the two: a budget chooses the error and what it takes");
    }
    refuse(budget && !options.cache.empty(), "--budget", "--cache",
           "give one of the two: light is kept for one error, a budget chooses it");
}

void render_once(const RenderOptions& options) {
    const FrameRequest request{.frame = true, .maps = options.aovs, .progress = {}};
    const double check = options.verify ? parse_seconds(*options.verify, "--verify") : 0.0;
    std::optional<Budget> budget;
    if (options.budget) budget.emplace().statistics.asked = parse_seconds(*options.budget, "--budget");
    PreparedScene prepared = prepare_scene(options.scene);
    if (check > 0.0) refuse_traced(prepared.settings);
    if (budget) {
        prepare_frames_output(prepared, options.scene, request, options.cache);
        if (!options.scene.quiet) std::cerr << "aleph: measuring parts of frames, to choose the error\n";
        const ThreadLimit limit(find_threads(options.scene.threads));
        apply_budget(prepared, options.scene, *budget);
        if (!options.scene.quiet) std::cerr << describe_choice(budget->statistics);
    }
    if (options.scene.strict && !(prepared.settings.error > 0.0))
        throw InputError("--strict", "--error", "no error is asked for that frames could keep to");
    render_frames(std::move(prepared), options.scene, request, options.cache, budget, check);
}

int render(RenderOptions options) {
    options.scene.keeps_to_error = !options.budget;
    refuse_contradictions(options);
    const FilmFolder folder = choose_film(options.scene, {.frame = true, .maps = options.aovs, .progress = {}});
    run_maybe_watched(options.watch, options.scene, [&] { render_once(options); });
    return exit_done;
}

}  // namespace

void add_render_command(CLI::App& app, Command& command) {
    CLI::App* render_app = app.add_subcommand("render", "render frames of a scene to EXR or PNG files, or as a film");
    const auto options = std::make_shared<RenderOptions>();
    add_scene_options(*render_app, options->scene);
    render_app->add_flag("--aovs", options->aovs, "also write the channels of `aleph maps` (EXR only)");
    add_watch_options(*render_app, options->watch);
    render_app
        ->add_option_function<std::string>(
            "--checkpoint",
            [options](const std::string& text) { options->scene.checkpoint = parse_seconds(text, "--checkpoint"); },
            "while a frame is made, keep its records and samples in a file every so many seconds, and when a signal "
            "stops it: --resume goes on from there. --cache keeps the light of lighting keyframes for other frames too")
        ->type_name("SECONDS");
    render_app
        ->add_option_function<std::string>(
            "--time-limit",
            [options](const std::string& text) { options->scene.time_limit = parse_seconds(text, "--time-limit"); },
            "stop after so many seconds of a clock, loading included, and keep the state of the unfinished frame as "
            "--checkpoint does; the exit code is 75, and the same command goes on. A limit that is too short for "
            "anything new to be kept is exceeded")
        ->type_name("SECONDS")
        ->needs("--resume");
    add_text(*render_app, "--budget", "SECONDS", options->budget,
             "seconds of a clock, with the threads given, that all the frames asked for may take, loading and choosing "
             "included: picks the smallest error (--error, .1 to 10) that is predicted to fit; --spp, --sampling, "
             "--gather and --accuracy cannot be given beside it");
    add_text(*render_app, "--verify", "SECONDS", options->verify,
             "afterwards check the frames for so many seconds of a clock (at least 4 blocks of pixels): blocks of "
             "random frames are path traced, and the share of the pixels that are seen to differ is printed with its "
             "interval at 95 %");
    render_app
        ->add_flag(
            "--strict", options->scene.strict,
            "end with exit code 3 if all frames are made, but more than 1 % of the pixels of one are estimated to "
            "err by more than was asked for, its error is not known, or --verify measures more than 1 %")
        ->excludes("--watch");
    add_text(*render_app, "--cache", "FILE", options->cache,
             "keep the indirect light of lighting keyframes (--light-step) in this file, and use what it has; a file "
             "of another scene, other settings or another build is refused; a folder (FOLDER/) may be shared by "
             "processes and scenes");
    render_app->footer(render_footer);
    render_app->callback([options, &command] { command = [options] { return render(*options); }; });
}

}  // namespace aleph
