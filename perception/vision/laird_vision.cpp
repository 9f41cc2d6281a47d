// The thesis's model with constants for eyes that move freely.

#include "perception/vision/kelly_vision.h"
#include "perception/vision/vision_list.h"

namespace aleph {

const VisionModel& laird_vision() {
    static const KellyVision model("laird", "Kelly 1979 with the constants of Laird 2006", laird_2006);
    return model;
}

}  // namespace aleph
