#pragma once
// Frames of an animation, from the scene to the picture. The order of the stages is only here:
// pose(N), pose(N+1) -> first hits -> quick estimate -> motion field -> saliency, Aleph map -> accuracy -> picture.

#include <filesystem>
#include <memory>
#include <string>

#include "engine/scene/scene.h"
#include "render/frame_output.h"
#include "render/settings.h"

namespace aleph {

struct SequenceState;

/// Renders frames of one scene. It keeps the ray structures between frames, so that only what moves is updated; a frame
/// does not depend on the frames rendered before it.
class Sequence {
  public:
    /// Owns the scene from here on; std::move saves a copy.
    /// @param camera  name of a camera or of its node; empty: the scene's choice
    /// @throws InputError: settings out of range, no such camera, or a cage that cannot be subdivided
    Sequence(Scene scene, const RenderSettings& settings, const std::string& camera = "");
    ~Sequence();
    Sequence(Sequence&&) noexcept;

    /// @throws InputError if the camera has an aperture without a focus distance
    FrameOutput render(std::int64_t frame, const FrameRequest& request = {});

    /// Takes the light of key moments from a file that save_light wrote, if there is one. Frames have the same bytes
    /// with and without it. To be called before the first frame.
    /// @throws InputError naming the file, if it is not a complete cache file of this scene, these settings and this
    /// program, or if these settings have no key moments
    void load_light(const std::filesystem::path& path);

    /// Writes the light of all key moments that were loaded, and of those that were computed since.
    /// @throws OutputError; std::logic_error before load_light
    void save_light(const std::filesystem::path& path);

    /// The scene, its subdivision cages at the levels that are rendered.
    const Scene& scene() const;
    /// Factor on radiance: the scene's, or computed from its first frame.
    double exposure() const;
    /// First and last frame: the scene's, or the span of its keys.
    FrameRange range() const;

  private:
    std::unique_ptr<SequenceState> state_;
};

}  // namespace aleph
