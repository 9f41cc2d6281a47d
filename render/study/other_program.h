#pragma once
// Programs that studies use where they are installed: gnuplot, flip.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aleph {

/// The file of a program on the PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

struct ProgramOutput {
    int code = 0;      ///< exit code; -1 if it could not be started, or ended by a signal
    std::string text;  ///< of standard output
};

/// Runs a program without a shell, in a folder, and waits for it.
/// @param input  for its standard input
ProgramOutput run_program_in(const std::filesystem::path& folder, const std::vector<std::string>& command,
                             std::string_view input);

/// A new folder among those for temporary files, removed at the end.
class TemporaryFolder {
  public:
    /// @throws OutputError if it cannot be made
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace aleph
