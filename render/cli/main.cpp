// The program `aleph`. Each subcommand has a file of its own.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <iostream>

#include "render/cli/commands.h"

namespace {

/// Opens what was closed of standard input, output and errors. A file of ours would else get its number, and messages
/// would end up in it.
void open_standard_files() {
    int file = 0;
    while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_RDWR);
    if (file > STDERR_FILENO) ::close(file);
}

}  // namespace

int main(int argc, char** argv) {
    open_standard_files();
    // A write beyond the file size limit, or to a program that has ended, then fails with an error and does not end
    // this one. Programs that this one starts have the signals as always.
    std::signal(SIGXFSZ, [](int) {});
    std::signal(SIGPIPE, [](int) {});
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
