#include "render/settings/reference_settings.h"

#include <algorithm>

namespace aleph {

namespace {

/// Diffuse bounces of a reference: what is left out is at most albedo^16 of the light.
constexpr int full_light_bounces = 16;

}  // namespace

RenderSettings traced_reference_settings(const RenderSettings& settings) {
    RenderSettings out;
    out.picture.width = settings.picture.width;
    out.picture.height = settings.picture.height;
    out.light.bounces = std::max(settings.light.bounces, full_light_bounces);
    out.light.path_depth = settings.light.path_depth;
    out.light.integrator = Integrator::path;
    out.picture.subdivision_level = settings.picture.subdivision_level;
    out.guide.estimate = settings.guide.estimate;  // the automatic exposure is that of the estimate
    out.perception.guide = Guide::none;
    out.picture.filter = settings.picture.filter;
    return out;
}

}  // namespace aleph
