#include "render/time/estimate_moments.h"

#include <algorithm>

#include "render/surface/carried_point.h"

namespace aleph {

namespace {

/// Enough for the moments around a frame, their base moments, and those before and after them, at which a sequence
/// looks too.
constexpr std::size_t most_kept = 5;

/// What the nodes of a moment know of a surface of another frame, where that surface lies at the moment.
EstimateNodes::Interpolated read_moment(const EstimateMoment& moment, const PixelSurface& surface) {
    const std::optional<SurfacePoint> point = carry_point(moment.shading, surface.hit, surface.point);
    if (!point) return {};
    const CameraView& view = moment.posed.view;
    const glm::dvec3 place = to_camera(view, moment.shading.anchor + glm::dvec3(point->position));
    if (!(-place.z > view.near_plane)) return {};
    const glm::dvec2 pixel = project_camera_point(view, place) - 0.5;
    const glm::dvec2 inside = glm::clamp(pixel, glm::dvec2(0.0), glm::dvec2(view.width - 1, view.height - 1));
    if (!(glm::length(pixel - inside) <= moment.nodes.spacing(0))) return {};
    const double distance = view.orthographic ? 1.0 : glm::length(place);
    const auto footprint = static_cast<float>(distance / view.pixels_per_unit);
    return moment.nodes.interpolate({point->position, point->normal, footprint, Rgb(0.0f)}, inside,
                                    moment.nodes.levels(), NodeSpline::linear);
}

}  // namespace

BlendedEstimate::BlendedEstimate(std::shared_ptr<const EstimateMoment> before,
                                 std::shared_ptr<const EstimateMoment> after, double weight)
    : before_(std::move(before)), after_(std::move(after)), weight_(static_cast<float>(weight)) {}

std::optional<Rgb> BlendedEstimate::find(const PixelSurface& surface) const {
    constexpr float reliable = 0.5f;
    const EstimateNodes::Interpolated before = read_moment(*before_, surface);
    const EstimateNodes::Interpolated after = before_ == after_ ? before : read_moment(*after_, surface);
    if (!(std::max(before.confidence, after.confidence) >= reliable)) return std::nullopt;
    const float known = (1.0f - weight_) * before.confidence + weight_ * after.confidence;
    return (before.irradiance * (1.0f - weight_) + after.irradiance * weight_) / known;
}

std::shared_ptr<const EstimateMoment> EstimateMoments::find(std::int64_t frame) {
    const auto found = std::ranges::find_if(moments_, [frame](const auto& moment) { return moment->frame == frame; });
    if (found == moments_.end()) return nullptr;
    std::rotate(moments_.begin(), found, found + 1);
    return moments_.front();
}

void EstimateMoments::keep(std::shared_ptr<const EstimateMoment> moment) {
    moments_.push_front(std::move(moment));
    if (moments_.size() > most_kept) moments_.pop_back();
}

}  // namespace aleph
