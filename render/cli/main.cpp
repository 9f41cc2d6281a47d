// The program `aleph`. Each subcommand has a file of its own.

#include <csignal>
#include <iostream>

#include "render/cli/commands.h"

int main(int argc, char** argv) {
    // A write beyond the file size limit then fails with an error, as on a full disk, and does not end the program.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app{
        "aleph renders animations with global illumination. It computes less where a viewer would not see the "
        "difference."};
    aleph::Command command;
    app.set_version_flag("--version", "aleph " ALEPH_VERSION);
    app.require_subcommand(0, 1);
    aleph::add_new_command(app, command);
    aleph::add_render_command(app, command);
    aleph::add_preview_command(app, command);
    aleph::add_maps_command(app, command);
    aleph::add_explain_command(app, command);
    aleph::add_export_command(app, command);
    aleph::add_study_command(app, command);
    aleph::add_compare_command(app, command);
    aleph::add_farm_command(app, command);
    app.footer("`aleph COMMAND --help` lists the options of a command, with examples.");
    return aleph::run_program(app, command, argc, argv, std::cerr);
}
