#pragma once
// Commands of `aleph` without starting the program.

#include "render/cli/commands.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {

struct Ran {
    int code = 0;
    std::string out, errors;
};

/// @param words  what follows `aleph`
inline Ran run_command(std::vector<std::string> words) {
    words.insert(words.begin(), "aleph");
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    std::ostringstream errors;
    testing::internal::CaptureStdout();
    const int code = run_aleph(static_cast<int>(argv.size()), argv.data(), errors);
    return {code, testing::internal::GetCapturedStdout(), errors.str()};
}

/// The command and its first options, then the others.
inline Ran run_command(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return run_command(std::move(words));
}

/// `aleph render` of cornell.
class RenderCommand : public testing::Test {
  protected:
    /// @return the exit code
    int run(std::vector<std::string> words, const std::vector<std::string>& more) {
        words.insert(words.begin(), {"render", (source_folder() / "scenes/cornell/scene.json").string(), "-q"});
        const Ran ran = run_command(std::move(words), more);
        errors = ran.errors, out = ran.out;
        return ran.code;
    }
    std::string file(const char* name) const { return (folder_.path() / name).string(); }

    std::string errors, out;

  private:
    ScratchFolder folder_;
};

}  // namespace aleph
