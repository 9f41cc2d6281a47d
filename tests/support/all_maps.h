#pragma once
// Results that the optimizer must not change: every map of one synthetic frame, by each model of vision.

#include <vector>

#include "perception/perception.h"
#include "tests/support/perception_scene.h"

namespace aleph {

inline std::vector<float> all_maps() {
    const SyntheticFrame frame = make_synthetic_frame(97, 71);
    std::vector<float> values;
    for (const VisionModel* const vision : {&thesis_vision(), &laird_vision(), &castle_vision()}) {
        for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
            const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {},
                                                           {.vision = vision, .grid = grid}, {true, true});
            for (const Image<float>* map :
                 {&maps.aleph, &maps.saliency, &maps.retinal_velocity, &maps.adaptation, &maps.conspicuity_intensity,
                  &maps.conspicuity_color, &maps.conspicuity_orientation, &maps.conspicuity_motion})
                values.insert(values.end(), map->pixels.begin(), map->pixels.end());
        }
    }
    return values;
}

}  // namespace aleph
