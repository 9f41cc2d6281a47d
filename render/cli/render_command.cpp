// `aleph render`: frames of a scene, guided by its Aleph maps.

#include "render/cli/commands.h"
#include "render/cli/scene_options.h"

namespace aleph {

void add_render_command(CLI::App& app, Command& command) {
    CLI::App* render = app.add_subcommand("render", "render frames of a scene");
    const auto options = std::make_shared<SceneOptions>();
    const auto aovs = std::make_shared<bool>(false);
    add_scene_options(*render, *options);
    render->add_flag("--aovs", *aovs, "write every map beside the picture, as `aleph maps` does");
    render->footer(
        "Accuracy costs time: --accuracy is the error that irradiance caching may make where the viewer is strictest; "
        "the Aleph map relaxes it elsewhere. --guide none keeps it the same everywhere.\n\n"
        "Examples:\n"
        "  aleph render scenes/pool/scene.json --frames 20 --spp 1 -o frame.png          a quick look\n"
        "  aleph render scenes/pool/scene.json -o out/ --stats out/stats.json            the whole shot\n"
        "  aleph render scenes/pool/scene.json --frames 20 --guide none -o unguided.exr  the baseline\n"
        "  aleph render scenes/pool/scene.json --frames 20 --accuracy 0 --gather 4096 --spp 1 -o dense.exr");
    render->callback([options, aovs, &command] {
        command = [options, aovs] {
            write_frames(prepare_scene(*options), *options, {.frame = true, .maps = *aovs, .progress = {}}, *aovs,
                         "render");
            return exit_done;
        };
    });
}

}  // namespace aleph
