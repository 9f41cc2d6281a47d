#pragma once
// The subcommands. Each function adds one to the program; when it is chosen, it sets the command that is to be run.

#include "render/cli/support/command.h"

namespace aleph {

void add_new_command(CLI::App& app, Command& command);
void add_render_command(CLI::App& app, Command& command);
void add_preview_command(CLI::App& app, Command& command);
void add_maps_command(CLI::App& app, Command& command);
void add_farm_command(CLI::App& app, Command& command);
void add_explain_command(CLI::App& app, Command& command);
void add_export_command(CLI::App& app, Command& command);
void add_study_command(CLI::App& app, Command& command);
void add_compare_command(CLI::App& app, Command& command);

/// The program `aleph` with all of them. Errors are reported as by run_program.
int run_aleph(int argc, const char* const* argv, std::ostream& errors);

}  // namespace aleph
