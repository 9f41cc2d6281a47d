#include "render/time/estimate_keyframes.h"

#include <algorithm>

namespace aleph {

namespace {

/// Enough for the keyframes around a frame, their base keyframes, and those before and after them, at which a sequence
/// looks too.
constexpr std::size_t most_kept = 5;

/// Reads the nodes of a keyframe for a surface of another frame, where that surface lies at the keyframe.
EstimateNodes::Interpolated read_keyframe(const EstimateKeyframe& keyframe, const PixelSurface& surface) {
    const std::optional<SurfacePoint> point = carry_point(keyframe.shading, surface.hit, surface.point);
    if (!point) return {};
    const CameraView& view = keyframe.posed.view;
    const glm::dvec3 place = to_camera(view, keyframe.shading.anchor + glm::dvec3(point->position));
    if (!(-place.z > view.near_plane)) return {};
    const glm::dvec2 pixel = project_camera_point(view, place) - 0.5;
    const glm::dvec2 inside = glm::clamp(pixel, glm::dvec2(0.0), glm::dvec2(view.width - 1, view.height - 1));
    if (!(glm::length(pixel - inside) <= keyframe.nodes.spacing(0))) return {};
    const double distance = view.orthographic ? 1.0 : glm::length(place);
    const auto footprint = static_cast<float>(distance / view.pixels_per_unit);
    return keyframe.nodes.interpolate({point->position, point->normal, footprint, Rgb(0.0f)}, inside,
                                      keyframe.nodes.levels(), NodeSpline::linear);
}

}  // namespace

BlendedEstimate::BlendedEstimate(std::shared_ptr<const EstimateKeyframe> before,
                                 std::shared_ptr<const EstimateKeyframe> after, double weight)
    : before_(std::move(before)), after_(std::move(after)), weight_(static_cast<float>(weight)) {}

std::optional<Rgb> BlendedEstimate::find(const PixelSurface& surface) const {
    constexpr float reliable = 0.5f;
    const EstimateNodes::Interpolated before = read_keyframe(*before_, surface);
    const EstimateNodes::Interpolated after = before_ == after_ ? before : read_keyframe(*after_, surface);
    if (!(std::max(before.confidence, after.confidence) >= reliable)) return std::nullopt;
    const float known = (1.0f - weight_) * before.confidence + weight_ * after.confidence;
    return (before.irradiance * (1.0f - weight_) + after.irradiance * weight_) / known;
}

std::shared_ptr<const EstimateKeyframe> EstimateKeyframes::find(std::int64_t frame) {
    const auto found =
        std::ranges::find_if(keyframes_, [frame](const auto& keyframe) { return keyframe->frame == frame; });
    if (found == keyframes_.end()) return nullptr;
    std::rotate(keyframes_.begin(), found, found + 1);
    return keyframes_.front();
}

void EstimateKeyframes::keep(std::shared_ptr<const EstimateKeyframe> keyframe) {
    keyframes_.push_front(std::move(keyframe));
    if (keyframes_.size() > most_kept) keyframes_.pop_back();
}

}  // namespace aleph
