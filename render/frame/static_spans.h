#pragma once
// StaticSpans: runs of frames in which nothing changes. Such frames are rendered once and copied.

#include <functional>

#include "engine/pose/pose.h"
#include "engine/pose/steady.h"
#include "render/frame/frame_output.h"

namespace aleph {

/// Which frames have the same picture (README.md), as a function of the scene alone. Static spans end at both ends of
/// the range, and frames before it belong to none. A scene in which nothing ever changes is one static span, which
/// frames outside of the range belong to.
class StaticSpans {
  public:
    /// Keeps references to scene and shots.
    /// @param scene    its cuts include every change of cameras
    StaticSpans(const Scene& scene, const PosePlan& plan, const std::vector<CameraShot>& shots,
                std::function<glm::dvec2(std::int64_t frame)> shutter);

    /// The frame as which a frame is rendered: the first of its static span, or itself. The hold found last is kept, so
    /// that its other frames cost next to nothing.
    std::int64_t find_first(std::int64_t frame);

  private:
    bool is_static(std::int64_t first, std::int64_t last) const;
    std::int64_t search_first(std::int64_t frame, std::int64_t end, std::int64_t limit) const;

    const Scene& scene_;
    const std::vector<CameraShot>& shots_;
    const std::function<glm::dvec2(std::int64_t)> shutter_;
    const FrameRange range_;
    const SteadySpans spans_;
    std::int64_t first_ = 0, last_ = -1;  ///< frames of the static span found last, as far as it is known
};

/// The output of the frame rendered last, while other frames of its static span may need it.
class StaticFrame {
  public:
    /// A copy for a frame of the same static span, without times and counts; nothing if this holds another frame, or if
    /// other contents are requested.
    std::optional<FrameOutput> copy(std::int64_t first, const FrameRequest& request) const;

    void keep(std::int64_t first, const FrameRequest& request, const FrameOutput& output);
    void drop() { output_.reset(); }

  private:
    std::int64_t first_ = 0;
    bool frame_ = false, maps_ = false;  ///< what was requested; the output has its window
    std::optional<FrameOutput> output_;
};

}  // namespace aleph
