// The thesis's model of vision (Yee 2000, 5.6 to 5.10).

#include "perception/vision/kelly_vision.h"
#include "perception/vision/vision_list.h"

namespace aleph {

const VisionModel& thesis_vision() {
    static const KellyVision model("thesis", "Kelly 1979 with the thesis's constants", daly_1998);
    return model;
}

}  // namespace aleph
