#pragma once
// The check of viewing conditions that every function of the vision model makes.

#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/viewing.h"

namespace aleph {

/// @throws InputError if pixels per degree or the white of the display is not positive and finite, or persistence is
/// not in [0,1]
inline void check_viewing(const ViewingConditions& viewing) {
    const auto check = [](double value, const char* name) {
        if (!(std::isfinite(value) && value > 0.0)) throw InputError("", name, "must be positive and finite");
    };
    check(viewing.pixels_per_degree, "pixels per degree");
    check(viewing.display_white, "display white");
    if (!(viewing.persistence >= 0.0 && viewing.persistence <= 1.0)) {
        throw InputError("", "persistence", "must be from 0 to 1");
    }
}

}  // namespace aleph
