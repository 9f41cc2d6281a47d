// `aleph render`: renders frames of a scene, with an accuracy that follows their Aleph maps.

#include "render/cli/commands.h"
#include "render/cli/write_frames.h"

namespace aleph {

void add_render_command(CLI::App& app, Command& command) {
    CLI::App* render = app.add_subcommand("render", "render frames of a scene to EXR or PNG files");
    const auto options = std::make_shared<SceneOptions>();
    const auto aovs = std::make_shared<bool>(false);
    const auto cache = std::make_shared<std::string>();
    add_scene_options(*render, *options);
    render->add_flag("--aovs", *aovs, "also write the channels of `aleph maps` (EXR only)");
    render
        ->add_option(
            "--cache", *cache,
            "keep the indirect light of key moments (--light-step) in this file: it is read if it exists, and "
            "written after the last frame; a file of another scene, other settings or another build is refused")
        ->type_name("FILE");
    render->footer(
        "--error is the simplest way: the largest error, in differences that a viewer just sees (1 is one of them). It "
        "chooses accuracy, gather rays and samples; options given beside it override them. Afterwards the program "
        "prints "
        "what share of the pixels it expects to err by more; --aovs has the error of every pixel and its causes.\n"
        "--accuracy is the error that irradiance caching may make where the viewer is strictest. Elsewhere the Aleph "
        "map "
        "allows more, which saves time; with --guide none the accuracy is the same everywhere.\n"
        "Indirect light is computed at key moments, every --light-step frames, at both sides of a cut and at the last "
        "frame; frames between two of them interpolate. A frame rendered alone takes two of them and their middle, a "
        "sequence two more for each step. --integrator path does not use them.\n"
        "The file has the channels R, G, B and A. `aleph maps --help` describes those that --aovs adds.\n\n"
        "Examples:\n"
        "  aleph render scenes/pool/scene.json --frames 20 --error 1 -o frame.exr        no visible error\n"
        "  aleph render scenes/pool/scene.json --frames 20 --spp 1 -o frame.png          a quick look\n"
        "  aleph render scenes/pool/scene.json -o out/ --stats out/stats.json            the whole shot\n"
        "  aleph render scenes/pool/scene.json --frames 20 --guide none -o unguided.exr  the baseline\n"
        "  aleph render scenes/pool/scene.json --frames 20 --accuracy 0 --gather 4096 --spp 1 -o dense.exr");
    render->callback([options, aovs, cache, &command] {
        command = [options, aovs, cache] {
            render_frames(prepare_scene(*options), *options, {.frame = true, .maps = *aovs, .progress = {}}, *cache);
            return exit_done;
        };
    });
}

}  // namespace aleph
