#pragma once
// The subcommands: each adds itself to the program and, when it is chosen, sets what is to be run.

#include "render/cli/options.h"

namespace aleph {

void add_render_command(CLI::App& app, Command& command);
void add_maps_command(CLI::App& app, Command& command);
void add_explain_command(CLI::App& app, Command& command);
void add_compare_command(CLI::App& app, Command& command);

}  // namespace aleph
