#pragma once
// Runs: frames rendered with one variant's settings, what they took, and the folder that keeps them.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/settings/settings.h"

namespace aleph {

/// Time and work of a frame, with the lighting keyframes that it was the first to need.
struct FrameRun {
    std::int64_t frame = 0;
    double processor_seconds = 0.0;  ///< of all threads
    double wall_seconds = 0.0;
    std::vector<std::pair<std::string, double>> stages;  ///< seconds of a clock; "keyframes" last
    std::vector<std::pair<std::string, double>> rays;    ///< by kind
    double samples = 0.0;                                ///< per pixel
    double records = 0.0;
    std::string plan;   ///< of effects, JSON (effect_table.h)
    bool timed = true;  ///< false: another program made it, and what it took is not known
};

/// Seconds of a processor that the program has used so far, in all its threads: less disturbed by other programs than
/// the time of a clock.
double processor_seconds();

/// Receives the picture of each frame of a run.
using SaveFrame = std::function<void(std::int64_t frame, const ChannelImage& picture)>;

/// Renders the frames in order with one Sequence, as `aleph render` does, so that later frames find the light of key
/// keyframes that earlier ones needed. The pictures hold R, G, B, A, indirect.R/G/B and every map that rendering makes
/// anyway. Writing files is not timed.
/// @param progress  called with the share that is done, 0 to 1; may be empty
/// @throws InputError as Sequence
std::vector<FrameRun> render_run(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                                 const SaveFrame& save, const std::function<void(double)>& progress);

/// All frames of a scene in one variant, once.
struct RunName {
    std::string scene;     ///< its name
    std::string variant;   ///< its name
    std::string identity;  ///< of everything that the result depends on, but for the numbers below and the build
    std::uint32_t seed = 0;
    int repeat = 0;
};

/// The folder of a study: finished runs with their pictures, so that a study that was stopped goes on.
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
