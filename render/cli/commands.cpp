#include "render/cli/commands.h"

#include "render/cli/support/options.h"

namespace aleph {

int run_aleph(int argc, const char* const* argv, std::ostream& errors) {
    CLI::App app{
        "aleph renders animations with global illumination. It computes less where a viewer would not see the "
        "difference."};
    Command command;
    app.set_version_flag("--version", "aleph " ALEPH_VERSION);
    app.require_subcommand(0, 1);
    add_new_command(app, command);
    add_render_command(app, command);
    add_preview_command(app, command);
    add_maps_command(app, command);
    add_explain_command(app, command);
    add_export_command(app, command);
    add_study_command(app, command);
    add_compare_command(app, command);
    add_farm_command(app, command);
    app.footer("`aleph COMMAND --help` lists the options of a command, with examples.");
    return run_program(app, command, argc, argv, errors);
}

}  // namespace aleph
