// The program `aleph`: names its subcommands and leaves the rest to them.

#include <csignal>
#include <iostream>

#include "render/cli/commands.h"

int main(int argc, char** argv) {
    // A file-size limit then shows as a failed write, with a message, like a full disk.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app{
        "aleph renders animations with global illumination, and spends its effort where a viewer would notice."};
    aleph::Command command;
    app.set_version_flag("--version", "aleph " ALEPH_VERSION);
    app.require_subcommand(0, 1);
    aleph::add_render_command(app, command);
    aleph::add_maps_command(app, command);
    aleph::add_explain_command(app, command);
    aleph::add_compare_command(app, command);
    app.footer("`aleph COMMAND --help` shows a command's options, with examples.");
    return aleph::run_program(app, command, argc, argv, std::cerr);
}
