// Light of the environment: by cosine or by its picture, and towards openings.

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/sampling.h"
#include "render/light/lights.h"
#include "render/surface/environment_map.h"

namespace aleph {

namespace {

/// Density of samples that are not for openings.
float pdf_anywhere(const ShadingScene& shading, const Receiver& receiver, const glm::vec3& direction) {
    if (shading.environment.map != nullptr)
        return pdf_environment(*shading.environment.map, direction * shading.environment.rotation);
    return pdf_cosine_hemisphere(glm::dot(receiver.normal, direction));
}

LightSample sample_anywhere(const ShadingScene& shading, const Receiver& receiver, const glm::vec2& u) {
    LightSample sample;
    if (shading.environment.map != nullptr) {
        const EnvironmentSample picture = sample_environment(*shading.environment.map, u);
        sample.direction = shading.environment.rotation * picture.direction;
        sample.pdf = picture.pdf;
    } else {
        const glm::vec3 local = sample_cosine_hemisphere(u);
        sample.direction = make_basis(receiver.normal).to_world(local);
        sample.pdf = pdf_cosine_hemisphere(local.z);
    }
    return sample;
}

/// Share of the samples that go towards openings. A picture may have a sun, which only its own samples find.
float openings_share(const ShadingScene& shading) {
    return shading.environment.map != nullptr ? 0.5f : 0.75f;
}

}  // namespace

LightSample sample_surroundings(const ShadingScene& shading, const Receiver& receiver, glm::vec2 u) {
    LightSample sample;
    const SkyOpenings* const openings = receiver.openings;
    const SeenOpenings seen = openings != nullptr ? see_openings(*openings, receiver) : SeenOpenings{};
    if (seen.total > 0.0f) {
        const float share = openings_share(shading);
        const bool for_openings = u.x < share;
        u.x = std::min(for_openings ? u.x / share : (u.x - share) / (1.0f - share), 0x1.fffffep-1f);
        sample.direction = for_openings ? sample_openings(*openings, seen, receiver.position, u)
                                        : sample_anywhere(shading, receiver, u).direction;
        sample.pdf = std::lerp(pdf_anywhere(shading, receiver, sample.direction),
                               pdf_openings(*openings, seen, receiver.position, sample.direction), share);
    } else {
        sample = sample_anywhere(shading, receiver, u);
    }
    sample.distance = std::numeric_limits<float>::infinity();
    if (sample.pdf > 0.0f) sample.incoming = environment_radiance(shading, sample.direction) / sample.pdf;
    return sample;
}

float pdf_environment(const ShadingScene& shading, const Receiver& receiver, const glm::vec3& direction) {
    const float anywhere = pdf_anywhere(shading, receiver, direction);
    if (receiver.openings == nullptr) return anywhere;
    const SeenOpenings seen = see_openings(*receiver.openings, receiver);
    if (!(seen.total > 0.0f)) return anywhere;
    return std::lerp(anywhere, pdf_openings(*receiver.openings, seen, receiver.position, direction),
                     openings_share(shading));
}

}  // namespace aleph
