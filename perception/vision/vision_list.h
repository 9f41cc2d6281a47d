#pragma once
// The models of vision.

#include <string_view>
#include <vector>

namespace aleph {

class VisionModel;

// The one list of them, in the order in which help shows them. Each is a function that returns the model, in a file of
// its name.
#define ALEPH_VISION_MODELS thesis_vision, laird_vision, castle_vision

using VisionFunction = const VisionModel&();
VisionFunction ALEPH_VISION_MODELS;

/// All models of the list.
const std::vector<const VisionModel*>& vision_list();

/// The model of that name; null if the list has none.
const VisionModel* find_vision(std::string_view name);

}  // namespace aleph
