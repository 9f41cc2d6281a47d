#pragma once
// A frame before its picture: pose, first hits and, where something obeys it, estimate, motion and the model of vision.

#include "render/frame/frame_estimate.h"
#include "render/frame/frame_motion.h"
#include "render/shade/progressive.h"

namespace aleph {

struct PreparedFrame {
    FramePlan plan;
    SampleHits centers;  ///< hits through the pixel centres
    FrameOutput out;     ///< all but the picture
    Image<float> swing;  ///< blur_frame_estimate; empty: the shutter is closed
};

struct SequenceState;

/// The stages of a frame before its picture, with their times and counts.
/// @param here  posed and prepared for the frame; without what its plan leaves out
PreparedFrame prepare_frame(SequenceState& s, FrameScene& here, FrameWork work);

/// Outlines beside which more is seen. Empty where nothing is known of what a viewer sees.
/// @param shading  of the frame
Image<Outline> find_visible_outlines(const Shot& shot, const ShadingScene& shading, const PreparedFrame& frame);

/// Refers to the outlines and to the frame.
VisibleLimits make_visible_limits(const Shot& shot, const PreparedFrame& frame, const Image<Outline>& outlines);

/// The tolerance of a lighting keyframe's records (KeyView); empty where no error is asked for.
/// @param shading  of the keyframe
Image<float> find_record_tolerance(const Shot& shot, const ShadingScene& shading, const PreparedFrame& keyframe);

}  // namespace aleph
