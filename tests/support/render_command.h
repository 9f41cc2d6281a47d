#pragma once
// `aleph render` of cornell, in this process.

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "render/cli/commands.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace aleph {

class RenderCommand : public testing::Test {
  protected:
    /// @return the exit code
    int run(const std::vector<std::string>& more) {
        std::vector<std::string> words = {"aleph", "render", (source_folder() / "scenes/cornell/scene.json").string(),
                                          "-q"};
        words.insert(words.end(), more.begin(), more.end());
        std::vector<const char*> argv;
        for (const std::string& word : words) argv.push_back(word.c_str());
        CLI::App app{"aleph"};
        Command command;
        add_render_command(app, command);
        errors.str("");
        return run_program(app, command, static_cast<int>(argv.size()), argv.data(), errors);
    }
    std::string file(const char* name) const { return (folder_.path() / name).string(); }

    std::ostringstream errors;

  private:
    ScratchFolder folder_;
};

}  // namespace aleph
