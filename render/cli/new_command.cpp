// `aleph new`: a scene to begin with.

#include <filesystem>
#include <iostream>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "render/cli/commands.h"
#include "render/cli/support/options.h"

namespace aleph {

namespace {

constexpr const char* first_scene =
#include "first_scene.inc"
    ;

void write_first_scene(const std::string& file) {
    const std::filesystem::path path(file);
    if (path.extension() != ".json")
        throw InputError(printable(file, 4096), "", "the name of a scene file ends in .json");
    if (std::filesystem::exists(std::filesystem::symlink_status(path)))
        throw InputError(printable(file, 4096), "", "the file is there already; give another name");
    try_output(path);
    write_file(path, first_scene);
    std::cout << "wrote " << printable(file, 4096) << "; its first lines say what to do with it\n";
}

}  // namespace

void add_new_command(CLI::App& app, Command& command) {
    CLI::App* start = app.add_subcommand("new", "write a first scene, with comments, to begin with");
    const auto file = std::make_shared<std::string>();
    add_text(*start, "scene", "NAME.json", *file, "name of the new scene file")->required();
    start->footer(
        "The scene has a floor, a lamp, a ball and a box that move, and a camera; every part says what it does. "
        "scenes/AUTHORING.md has all keys, scenes/scene.schema.json completes them in editors.\n\n"
        "Examples:\n"
        "  aleph new first.json && aleph preview first.json");
    start->callback([file, &command] {
        command = [file] {
            write_first_scene(*file);
            return exit_done;
        };
    });
}

}  // namespace aleph
