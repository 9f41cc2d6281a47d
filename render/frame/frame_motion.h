#pragma once
// Motion of a frame to its other frame, and of the first frame after an edit from the frame rendered before it.

#include <memory>
#include <optional>

#include "motion/model_motion.h"
#include "motion/picture_motion.h"
#include "render/frame/frame_estimate.h"
#include "render/settings/measure.h"
#include "render/settings/motion_source.h"

namespace aleph {

struct PreparedFrame;

/// The frame rendered last before an edit.
struct FrameBeforeEdit {
    std::int64_t frame = 0;
    PosedView posed;
    bool same_triangles = true;  ///< as after the edit
};

/// Keeps the scene at the other frame, and updates what moves.
class FrameMotion {
  public:
    /// Keeps references. @param meshes  whose mesh structures the other frame's scene shares
    FrameMotion(const Shot& shot, const FrameScene& meshes) : shot_(shot), other_(shot, meshes) {}

    /// Motion of the next frame that is prepared leads from this one, of the scene before it was edited.
    void begin_edited(FrameBeforeEdit before);
    /// Returns whether begin_edited was called and the frame after it has not been rendered yet.
    bool is_edited() const { return before_edit_.has_value(); }
    /// Later frames have the motion of the scene's tracks. @return the frame given to begin_edited
    std::optional<FrameBeforeEdit> end_edited();

    /// Poses the scene at the other frame.
    /// @return the other frame; after an edit none if the frame before it has other elements or is of another shot
    OtherFrame pose_other(const FrameWork& work, const PosedView& here);

    /// Motion of a frame whose estimate is made, with the hidden pixels if maps are wanted. After pose_other.
    /// @param clock  adds an estimate of the other frame to that stage
    void compute(const FrameWork& work, const FrameScene& here, EstimateLight& light, StageClock& clock,
                 PreparedFrame& frame);

    /// Image velocity, deg/s. Where a pixel shows surfaces behind glass or blended ones, that of the slowest: the eye
    /// rests on it, and sees errors there best. After compute.
    Image<float> find_velocity(const FrameWork& work, const FrameScene& here, PreparedFrame& frame);

    /// Motion to the frame before, with the hidden pixels. The first frame's is its motion to the next one, turned
    /// round; behind a cut there is none. Nothing after an edit, and where quick estimates are compared. After compute.
    void compute_backward(const FrameWork& work, const FrameScene& here, PreparedFrame& frame);

    /// The scene at other frames, for others to pose: it is needed from pose_other to compute_backward only.
    FrameScene& other() { return other_; }
    TracedRays traced() const { return edited_ ? other_.traced() + edited_->traced() : other_.traced(); }

  private:
    const PosedView& other_view() const { return from_edit_ ? before_edit_->posed : other_.posed(); }
    bool is_found_before_edit(const FrameWork& work, const PosedView& here) const;
    FrameScene& other_scene(const FrameScene& here);
    /// The points of each pixel that motion is of: the hits, or the items.
    const Image<Hit>& points(const Image<Hit>& hits) const;
    MotionField compute_from_scene(const PosedView& here, const PosedView& other, const Image<Hit>& hits,
                                   OtherFrame which);
    /// Compares the frame's quick estimate with that of the other frame, which is made here.
    MotionField search_other(const FrameWork& work, const FrameScene& here, EstimateLight& light, PictureSearch search,
                             StageClock& clock, PreparedFrame& frame);

    const Shot& shot_;
    FrameScene other_;
    std::optional<ModelMotion> model_;
    Image<Hit> items_;  ///< of the frame in work, where motion is from rasterized maps
    std::optional<FrameBeforeEdit> before_edit_;
    PosePlan all_;                        ///< an edit may have moved what the scene's own tracks leave at rest
    bool from_edit_ = false;              ///< motion leads from before_edit_
    std::unique_ptr<FrameScene> edited_;  ///< the scene before an edit, once its rays are needed
};

}  // namespace aleph
