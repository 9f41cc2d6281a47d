// `aleph export`: writes a scene in another format.

#include <memory>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/load/load_scene.h"
#include "engine/pose/frame_keys.h"
#include "render/cli/commands.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/options.h"
#include "render/cli/support/output_path.h"

namespace aleph {

namespace {

struct ExportOptions {
    std::string scene, output;
    LoadLimits limits;
    bool bake = false, quiet = false;
};

int export_scene(const ExportOptions& options) {
    require_format(scene_formats(), FormatUse::save, options.output, options.output, "--output");
    const ReadFiles read;
    Scene scene = load_scene(options.scene, options.limits);
    if (options.bake && lower_extension(options.output) == ".json" && !scene.source.includes.empty())
        throw InputError("", "--bake", "a .json includes other files, whose motion stays as it is; name a .glb file");
    refuse_overwriting(read.paths(), {{options.output, "--output"}});
    try_output(options.output);
    if (!options.quiet) print_warnings(scene.source.warnings);
    if (options.bake) key_frames(scene);
    const std::vector<std::string> losses = save_scene(scene, options.output);
    if (!options.quiet) print_warnings(losses);
    return exit_done;
}

constexpr const char* footer =
    "A .glb is glTF 2.0 in one file, for Blender and others: nodes, meshes, skins, materials with their textures, "
    "lights, cameras and their motion over time, with all that the scene includes.\n"
    "Keys are in seconds. Step, linear and cubic keys stay what they are; turns about an axis become keys less than "
    "half a turn apart. Sampled at the scene's frames, and straight between them: transform operations of Alembic and "
    "keyed matrices that shear, nodes that leave their parent's transform. A shear takes two nodes, NAME.shear and "
    "NAME. Points that move become morph targets, one for each shape. Subdivision surfaces have the level of the scene "
    "file. What is hidden or not there at all times is said by KHR_node_visibility, changing materials, lights and "
    "lenses by KHR_animation_pointer: programs that do not know these show everything, as it is first.\n"
    "Not written, with a warning each: the environment, exposure, cuts, which camera looks and when, aperture, focus, "
    "lens shift and shutter, the display, settings. Not written either: frame rate and range. What moves before 0 s is "
    "left out. Textures are PNG of 8 bits a channel. Keys are 32-bit floats: see engine/gltf/write/README.md.\n"
    "A .json is aleph's own format; files that the scene includes stay included.\n\n"
    "Examples:\n"
    "  aleph export scenes/pool/scene.json -o pool.glb          for other programs\n"
    "  aleph export scenes/pool/scene.json --bake -o pool.glb   for Blender\n"
    "  aleph export shot.abc -o shot.glb                        Alembic as glTF\n"
    "  aleph export model.glb -o model.json                     a scene file that includes the model, to add to";

}  // namespace

void add_export_command(CLI::App& app, Command& command) {
    CLI::App* sub = app.add_subcommand("export", "write a scene as glTF, for other programs");
    const auto options = std::make_shared<ExportOptions>();
    add_scene_argument(*sub, options->scene);
    add_text(*sub, "-o,--output", "FILE", options->output,
             "file to write: " + list_endings(scene_formats(), FormatUse::save))
        ->required();
    sub->add_flag("--bake", options->bake,
                  "give turns and cubic motion a key at every frame, for programs that interpolate otherwise than glTF "
                  "says, as Blender does: at frames they then show what aleph shows");
    sub->add_flag("-q,--quiet", options->quiet, "print no warnings");
    add_load_limits(*sub, options->limits);
    sub->footer(footer);
    sub->callback([options, &command] { command = [options] { return export_scene(*options); }; });
}

}  // namespace aleph
