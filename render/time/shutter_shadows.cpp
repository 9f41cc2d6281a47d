#include "render/time/shutter_shadows.h"

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"

namespace aleph {

float find_sunlight_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers,
                           const glm::vec3& position, const glm::vec3& moved, int instance, float enough) {
    float change = 0.0f;
    for (const LightValues& light : frame.pose->lights) {
        if (light.kind != Light::Kind::directional) continue;
        const glm::vec3 along(light.direction);
        const auto find_distance = [&](const glm::vec3& from, const glm::vec3& to) {
            return glm::length(to - from - std::max(0.0f, glm::dot(to - from, along)) * along);
        };
        for (const ShutterMover& mover : movers) {
            if (!(mover.radius > 0.0f) || mover.instance == instance) continue;
            const float distance =
                std::min(find_distance(mover.centers[0], position), find_distance(mover.centers[1], position + moved));
            const float way = mover.moved + glm::length(moved), steps = way > 0.0f ? 3.0f * way / distance : 0.0f;
            change += find_hidden_share(mover.radius, distance) * std::min(1.0f, steps + mover.faded);
            if (change > enough) return change;
        }
    }
    return change;
}

}  // namespace aleph
