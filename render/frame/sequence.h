#pragma once
// Frames of an animation, from the scene to the picture. The order of the stages is only here:
// pose(N), pose(N+1) -> first hits -> quick estimate -> motion field -> saliency, Aleph map -> accuracy -> picture.

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/scene/scene.h"
#include "render/frame/frame_output.h"
#include "render/pixels/picture_part.h"
#include "render/settings/settings.h"

namespace aleph {

struct SequenceState;

/// Time and work of a part of a frame's picture.
struct PartTime {
    double fill = 0.0, shade = 0.0;          ///< s
    std::uint64_t samples = 0, records = 0;  ///< irradiance values
};

struct PartTimes {
    std::int64_t frame = 0;       ///< whose picture it is: for a copy, the frame that is rendered
    double before = 0.0;          ///< s, of all stages before light and samples, for the whole frame
    std::vector<PartTime> parts;  ///< by settings
};

/// Time that the light of a frame took, with nothing shaded; s.
struct LightTime {
    double fill = 0.0;       ///< for this frame
    double keyframes = 0.0;  ///< of the lighting keyframes that no frame before it needed
};

/// Random numbers and number of the samples of a part of a picture.
struct PartSamples {
    std::uint32_t seed = 0;
    int spp = 1;
};

/// Renders frames of one scene. It keeps the ray structures between frames, so that only what moves is updated; a frame
/// does not depend on the frames rendered before it.
class Sequence {
  public:
    /// Owns the scene from here on; std::move saves a copy.
    /// @param camera  name of a camera or of its node; empty: the scene's choice
    /// @throws InputError: settings out of range, a scene that `validate` refuses (engine/load/validate_scene.h), no
    /// such camera, or a cage that cannot be subdivided
    Sequence(Scene scene, const RenderSettings& settings, const std::string& camera = "");
    ~Sequence();
    Sequence(Sequence&&) noexcept;

    /// @throws InputError if the camera has an aperture without a focus distance, a frame is beyond is_frame
    /// (engine/base/frame_rate.h), a window is not within the picture, or this has been moved from
    FrameOutput render(std::int64_t frame, const FrameRequest& request = {});

    /// Times a part of a frame's picture with each of some settings, in their order. Its light is computed for the part
    /// alone, and not read from lighting keyframes.
    /// @param settings  that differ from the sequence's in what RenderSettings::error sets
    /// @param go_on     whether the next settings are to be timed; asked after all but the last
    /// @throws InputError as `render`
    PartTimes time_part(std::int64_t frame, const PicturePart& part, std::span<const RenderSettings> settings,
                        const std::function<bool(const PartTimes&)>& go_on);

    /// Times the light of a frame.
    /// @throws InputError as `render`
    LightTime time_light(std::int64_t frame);

    /// Pictures of a part of a frame, 0 elsewhere, one for each seed and number of samples, by paths: nothing of what
    /// they are made from is shared between pixels. Integrator::path without a guide.
    /// @param progress  as FrameRequest has it
    /// @throws InputError as `render`
    std::vector<Image<Rgb>> render_part(std::int64_t frame, const PicturePart& part,
                                        std::span<const PartSamples> pictures, const FrameProgress& progress = {});

    /// The first hits of a frame and its motion, with the hidden pixels: `hits` and `motion` of the output of `render`
    /// with all maps. MotionSource::model, and no edit before it.
    /// @throws InputError as `render`
    FrameOutput find_motion(std::int64_t frame);

    /// The effects plan of a frame, as `render` makes it for its picture: costs as much as the stages before shading.
    /// @throws InputError as `render`
    EffectsPlan plan(std::int64_t frame);

    /// Changes the scene between frames, as a simulation does that knows one step at a time. Costs as much as making a
    /// new sequence; exposure and settings stay, and `change` gets the scene as it was given. What the scene's own
    /// tracks animate needs no edit.
    ///
    /// The next frame's motion leads from the frame rendered last to this one, as in the last frame of a shot: the
    /// change of transforms, cameras and deforming points, whatever frame numbers they have. Where nodes, meshes,
    /// triangles or cameras were added or removed, another camera looks, or a cut lies between the two frames, the
    /// frame has no motion. Frames after it have that of the scene's tracks again. Points of a rigid mesh that are
    /// changed have the motion of its transform only.
    /// @throws InputError as the constructor does, and what `change` throws; this is then as it was before
    void edit(const std::function<void(Scene&)>& change);

    /// Keeps the light of lighting keyframes in a file, or in a folder (a path that ends in '/', or exists as one) that
    /// several processes share, and takes from it what it has. Frames have the same bytes with and without it. To be
    /// called before the first frame.
    /// @throws InputError naming the file, if it is not a complete cache file of this scene, these settings and this
    /// program, or if these settings have no lighting keyframes or an adapter of a program's own; OutputError if the
    /// folder cannot be made
    void load_light(const std::filesystem::path& path);

    /// Writes the file with the light of all lighting keyframes that were loaded, and of those that were computed
    /// since, if there are any. A folder has them already.
    /// @throws OutputError; std::logic_error before load_light
    void save_light();

    /// The scene, its subdivision cages at the levels that are rendered.
    const Scene& scene() const;
    /// Factor on radiance: the scene's, or computed from its first frame that is not black.
    double exposure() const;
    /// True where the exposure is 1 because no frame that was tried shows direct light.
    bool is_dark() const;
    /// First and last frame: the scene's, or the span of its keys.
    FrameRange range() const;

  private:
    SequenceState& state() const;
    /// @throws InputError unless is_frame(frame)
    SequenceState& state_for(std::int64_t frame) const;

    std::string camera_;  ///< as given
    std::unique_ptr<SequenceState> state_;
};

}  // namespace aleph
