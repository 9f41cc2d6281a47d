#pragma once
// Optical flow of two pictures: dense inverse search (Kroeger et al., "Fast Optical Flow using Dense Inverse Search",
// ECCV 2016) with variational refinement, by OpenCV.

#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

/// A picture as the flow compares it: the root of channel A (opponent_color.h), which is about how bright it looks, up
/// to white at 85 % of 255. Above it the root's inverse, so that what is brighter than white keeps its texture.
Image<std::uint8_t> make_flow_picture(const Image<Rgb>& frame);

/// Displacements between two pictures, pixels, x right, y down.
struct FlowPair {
    Image<glm::dvec2> there;  ///< of every pixel of the first, to the second
    Image<glm::dvec2> back;   ///< of every pixel of the second, to the first
};

/// Returns whether this was built with OpenCV.
bool has_flow();

/// Meanwhile OpenCV has one thread and no code chosen by processor, in the whole program: the bits are always the same.
/// @throws InputError if the sizes differ or are empty, or if this was built without OpenCV
FlowPair compute_flow(const Image<std::uint8_t>& first, const Image<std::uint8_t>& second);

}  // namespace aleph
