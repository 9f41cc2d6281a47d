#include "engine/scene_file/fields.h"

#include <fmt/format.h>

#include "engine/scene_file/tracks.h"

namespace aleph {

std::string describe_outside(const ValueRange& range, double value) {
    if (range.low == -max_json_number)
        return fmt::format("has to be finite and within +-{}, found {}", max_json_number, value);
    const bool limited = range.high < max_json_number;
    if (limited && range.above_low == range.below_high) {
        return fmt::format("has to lie between {} and {}{}, found {}", range.low, range.high,
                           range.above_low ? ", both excluded" : "", value);
    }
    const std::string least =
        fmt::format("{}{} {}", range.takes_zero ? "0 or " : "", range.above_low ? "above" : "at least", range.low);
    const bool tells_most = limited || value > range.high;
    return fmt::format("has to be {}{}, found {}", least, tells_most ? fmt::format(" and at most {}", range.high) : "",
                       value);
}

ValueRange in_radians(const ValueRange& degrees) {
    ValueRange range = degrees;
    range.low = to_radians(degrees.low);
    range.high = to_radians(degrees.high);
    return range;
}

const char* fault_of_cones(const Light& light) {
    const bool constant = light.inner_cone.values.size() == 1 && light.outer_cone.values.size() == 1;
    if (!constant || light.inner_cone.values[0] <= light.outer_cone.values[0]) return nullptr;
    return "\"inner_cone\", where the light begins to fade, cannot be wider than \"outer_cone\", where it ends";
}

}  // namespace aleph
