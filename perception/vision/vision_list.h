#pragma once
// The models of vision.

#include <string_view>
#include <vector>

namespace aleph {

class VisionModel;

// The one list of them, in the order in which help shows them. Each is a function that returns the model.
#define ALEPH_VISION_MODELS thesis_vision, laird_vision, castle_vision

using VisionFunction = const VisionModel&();
VisionFunction ALEPH_VISION_MODELS;

/// All models of the list, then those that programs added.
const std::vector<const VisionModel*>& vision_list();

/// The model of that name; null if the list has none.
const VisionModel* find_vision(std::string_view name);

/// Adds a model of a program's own, or puts it in the place of one of that name that was added before; add_vision
/// (render/settings/setting_table.h) lets settings name it too. The model has to last as long as the program. Not to be
/// called while anything renders.
/// @throws InputError if one of aleph's own models has its name
void add_to_vision_list(const VisionModel& model);

}  // namespace aleph
