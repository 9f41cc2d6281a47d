#pragma once
// What a viewer tolerates in a prepared frame, for the work that obeys it.

#include "render/frame/prepared_frame.h"
#include "render/shade/error_budget.h"

namespace aleph {

/// Outlines beside which more is seen. Empty where nothing is known of what a viewer sees.
/// @param shading  of the frame
Image<Outline> find_visible_outlines(const Shot& shot, const ShadingScene& shading, const PreparedFrame& frame);

/// Refers to the outlines and to the frame.
VisibleLimits make_visible_limits(const Shot& shot, const FrameOutput& out, const Image<Outline>& outlines);

/// The tolerance of a lighting keyframe's records (KeyView); empty where no error is asked for.
/// @param shading  of the keyframe
Image<float> find_record_tolerance(const Shot& shot, const ShadingScene& shading, const PreparedFrame& keyframe);

}  // namespace aleph
