#include "perception/vision/vision_list.h"

#include <algorithm>
#include <array>

#include "engine/base/errors.h"
#include "perception/vision/vision_model.h"

namespace aleph {

namespace {

std::vector<const VisionModel*>& all_models() {
    static std::vector<const VisionModel*> models = [] {
        std::vector<const VisionModel*> all;
        for (VisionFunction* const model : {ALEPH_VISION_MODELS}) all.push_back(&model());
        return all;
    }();
    return models;
}

constexpr std::size_t listed_models = std::to_array<VisionFunction*>({ALEPH_VISION_MODELS}).size();

}  // namespace

const std::vector<const VisionModel*>& vision_list() {
    return all_models();
}

void add_to_vision_list(const VisionModel& model) {
    std::vector<const VisionModel*>& models = all_models();
    const auto found = std::ranges::find(models, model.name(), &VisionModel::name);
    if (found == models.end()) {
        models.push_back(&model);
    } else if (static_cast<std::size_t>(found - models.begin()) < listed_models) {
        throw InputError("", "vision", model.name() + " is a model of aleph's own");
    } else {
        *found = &model;
    }
}

const VisionModel* find_vision(std::string_view name) {
    const auto found = std::ranges::find(vision_list(), name, &VisionModel::name);
    return found == vision_list().end() ? nullptr : *found;
}

}  // namespace aleph
