#pragma once
// The folder of a study: finished runs with their pictures, so that a study that was stopped goes on.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/study/timed_run.h"

namespace aleph {

/// All frames of a scene in one variant, once.
struct RunName {
    std::string scene;     ///< its name
    std::string variant;   ///< its name
    std::string identity;  ///< of everything that the result depends on, but for the numbers below and the build
    std::uint32_t seed = 0;
    int repeat = 0;
};

class RunStore {
  public:
    /// @throws OutputError if the folder cannot be made
    explicit RunStore(std::filesystem::path folder);

    const std::filesystem::path& folder() const { return folder_; }

    /// The frames of a finished run of this build, if there is one with all of its pictures.
    /// @throws InputError naming the file, if it is not as `save` wrote it
    std::optional<std::vector<FrameRun>> find(const RunName& name, const std::vector<int>& frames) const;

    /// Where a run keeps the picture of a frame. Repeats make equal pictures, and share them.
    std::filesystem::path picture(const RunName& name, std::int64_t frame) const;

    /// Notes a run as finished: after its pictures are written.
    /// @throws OutputError
    void save(const RunName& name, const std::vector<FrameRun>& frames) const;

  private:
    std::filesystem::path file(const RunName& name) const;

    std::filesystem::path folder_;
};

}  // namespace aleph
