#include "render/time/keyframe_light.h"

#include <algorithm>
#include <cmath>

#include "render/cache/aimed_rays.h"
#include "render/cache/bounce_places.h"
#include "render/cache/further_bounces.h"

namespace aleph {

namespace {

/// Pixels, of views at other times than the keyframe's. Frames fill the little that tiles of this size leave open.
constexpr int finest_tiles = 2;

/// Returns whether linear interpolation between two keyframes may err too much: half way, if they differ by more than
/// the accuracy, relative to their mean; nearer to one of them, if they differ by accordingly more, as the error of
/// linear interpolation is 0 at both ends. Smooth light is taken to change by the same share everywhere between: it
/// then lies below the line by an eighth of the square of that share, half way. Where nothing moves, how far brightness
/// is from linear is known, and light from 0 on is too.
bool differ(BetweenKeys between, const Rgb& before, const Rgb& after, float weight, float accuracy) {
    if (between == BetweenKeys::still || between == BetweenKeys::linear) return false;
    const float a = luminance(before), b = luminance(after), off = std::abs(a - b), mean = 0.5f * (a + b);
    const float error = between == BetweenKeys::smooth ? 0.125f * off * off : off * mean;
    return 4.0f * weight * (1.0f - weight) * error > accuracy * mean * mean;
}

/// Records of things at rest, in the coordinates of another pose.
std::vector<IrradianceRecord> shift_records(std::vector<IrradianceRecord> records, const ShadingScene& from,
                                            const ShadingScene& to) {
    const glm::vec3 shift(from.anchor - to.anchor);
    for (IrradianceRecord& record : records) record.position += shift;
    return records;
}

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

KeyframeRecords compute_records(const KeyframeInput& input, FrameCounts& counts) {
    const LightingContext& lighting = input.lighting;
    const CameraView& first = input.views.front()->posed.view;
    IrradianceCache cache = make_cache(lighting.shading);
    if (input.base != nullptr)
        cache.restore(shift_records(input.base->cache.records(), input.base->at->shading, lighting.shading));
    const std::size_t kept = cache.records().size();
    DirectGrid direct(scene_radius(lighting.shading));
    FrameTally tally;
    tally.records = tally.invalid_samples = Image<float>(first.width, first.height);
    std::vector<IndirectContext> contexts;
    std::vector<SampleHits> first_samples;
    std::vector<PixelSurface> seen;
    for (const auto& view : input.views) {
        contexts.push_back({.lighting = lighting,
                            .view = view->posed.view,
                            .settings = input.settings,
                            .accuracy = view->accuracy,
                            .max_radius = scene_radius(lighting.shading),
                            .progress = input.progress,
                            .checkpoint = input.checkpoint,
                            .direct = &direct,
                            .carried = input.carried,
                            .seen = view->frame == input.frame ? nullptr : &view->shading,
                            .tolerance = view->tolerance.empty() ? nullptr : &view->tolerance});
        first_samples.push_back(input.cast(*view, tally.counts.rays));
        add_seen_surfaces(contexts.back(), first_samples.back(), seen, tally.counts.rays);
    }
    const BrightSurfaces bright = find_bright_surfaces(lighting, seen, tally.counts.rays);
    for (IndirectContext& context : contexts) context.bright = bright.empty() ? nullptr : &bright;
    const std::optional<FurtherBounces> further_bounces = solve_further_bounces(contexts.front(), seen, tally.counts);
    for (std::size_t v = 0; v < contexts.size(); ++v) {
        contexts[v].bounces.further =
            make_multi_bounce_light(input.settings, further_bounces ? &*further_bounces : nullptr);
        fill_cache(cache, contexts[v], first_samples[v], tally, contexts[v].seen == nullptr ? 1 : finest_tiles);
        // Other views were cast in another pose, where mirrors may show other things.
        if (contexts[v].seen == nullptr) fill_mirror_places(cache, contexts[v], first_samples[v], tally);
    }
    tally.counts.rays += counts.rays;
    counts = tally.counts;
    cache.finish(kept, input.settings.error > 0.0);
    KeyframeRecords records{cache.records(), {}};
    if (input.still && further_bounces) records.further = further_bounces->cache.records();
    return records;
}

/// The records' order decides in which order a look-up adds them, so the cache is always made from the list, whether
/// it was computed or read from a file.
KeyframeLight make_keyframe_light(std::shared_ptr<const KeyPose> at, const KeyframeRecords& records) {
    KeyframeLight keyframe{at, make_cache(at->shading), records.further};
    keyframe.cache.restore(records.seen);
    keyframe.cache.prepare();
    return keyframe;
}

std::optional<Rgb> BlendedLight::read(const KeyframeLight& keyframe, const PixelSurface& surface, float accuracy,
                                      RayTask& task, RecordUse& used) const {
    const std::optional<SurfacePoint> point = carry_point(keyframe.at->shading, surface.hit, surface.point);
    if (!point) return std::nullopt;
    CacheQuery query{point->position, point->normal, accuracy * shade_reach};
    query.used = &used;
    // A surface that turned would need rays in the keyframe's own scene.
    if (point->edges[0] == surface.point.edges[0] && point->edges[1] == surface.point.edges[1]) {
        query.task = &task;
        query.ray_shift = surface.point.position - point->position;
    }
    return keyframe.cache.interpolate(query);
}

std::optional<Rgb> BlendedLight::interpolate(const PixelSurface& surface, float accuracy, RayTask& task,
                                             RecordUse& used) const {
    const std::optional<Rgb> before = read(*before_, surface, accuracy, task, used);
    if (!after_) return before;
    const std::optional<Rgb> after = read(*after_, surface, accuracy, task, used);
    if (!before || !after) {
        if (between_ == BetweenKeys::still) return before ? before : after;
        return std::nullopt;
    }
    if (differ(between_, *before, *after, weight_, accuracy)) return std::nullopt;
    return *before * (1.0f - weight_) + *after * weight_;
}

std::vector<IrradianceRecord> BlendedLight::find_further(const ShadingScene& frame) const {
    if (between_ != BetweenKeys::still) return {};
    const KeyframeLight& nearer = after_ && weight_ > 0.5f ? *after_ : *before_;
    return shift_records(nearer.further, nearer.at->shading, frame);
}

std::optional<Rgb> BlendedLight::find(const PixelSurface& surface, float accuracy, RayTask& task,
                                      RecordUse* used) const {
    RecordUse of_these;
    const std::optional<Rgb> found = interpolate(surface, accuracy, task, of_these);
    if (!found && finer_) return finer_->find(surface, accuracy, task, used);
    if (found && used != nullptr) used->add(of_these);
    return found;
}

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
