#include <algorithm>
#include <array>

#include "render/light_power.h"

namespace aleph {

void bound_illuminances(const LightBounds& lights, const glm::vec3& position, const glm::vec3& normal, float behind,
                        std::span<float> weights) {
    const glm::vec3 from = position, facing = normal;
    for (std::size_t first = 0; first < weights.size(); first += LightBounds::step) {
        // An array that nothing else overlaps: the loop becomes vector instructions.
        std::array<float, LightBounds::step> part;
        for (std::size_t i = 0; i < LightBounds::step; ++i) {
            part[i] = bound_illuminance(lights, first + i, from, facing, behind);
        }
        std::copy(part.begin(), part.end(), weights.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

}  // namespace aleph
