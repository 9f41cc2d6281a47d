#include "perception/vision/vision_list.h"

#include <algorithm>

#include "perception/vision/vision_model.h"

namespace aleph {

const std::vector<const VisionModel*>& vision_list() {
    static const std::vector<const VisionModel*> models = [] {
        std::vector<const VisionModel*> all;
        for (VisionFunction* const model : {ALEPH_VISION_MODELS}) all.push_back(&model());
        return all;
    }();
    return models;
}

const VisionModel* find_vision(std::string_view name) {
    const auto found = std::ranges::find(vision_list(), name, &VisionModel::name);
    return found == vision_list().end() ? nullptr : *found;
}

}  // namespace aleph
