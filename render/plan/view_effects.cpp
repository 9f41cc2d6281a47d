// Effects of the view: blur by shutter and lens, motion into the next frame, and where viewers look.

#include <fmt/format.h>

#include <algorithm>

#include "render/plan/effect_table.h"
#include "render/settings/motion_source.h"

namespace aleph {

namespace {

constexpr double half_pixel = 0.5;
constexpr double contrast_margin = 2.0;  // highlights may be brighter than what the estimate shows

/// Share of the picture's contrast that blur can change: by the slope and the curvature that a picture can have behind
/// the filter. Taylor's theorem; what moves alike to both sides of its place cancels to first order.
double bound_blur(const BlurMoments& blur, PixelFilter filter) {
    // Slope and curvature behind the filter of a picture between 0 and 1, along a line: of an edge, per pixel.
    const bool smooth = filter == PixelFilter::blackman_harris;
    const double slope = smooth ? 0.93 : 1.0;
    const double first = slope * blur.mean;
    if (!smooth) return std::min(1.0, first);
    constexpr double curvature = 2.7;
    return std::min({1.0, first, slope * blur.shift + 0.5 * curvature * blur.mean_square});
}

double largest_contrast(const Planning& frame) {
    double shines = 0.0;
    for (const ObjectFacts& object : frame.in.facts.objects) {
        if (object.in_view) shines = std::max(shines, double{object.material.radiance});
    }
    return contrast_margin * frame.visible->brightest / frame.in.luminance_scale + shines;
}

/// Blur may be left out where it is so small that the picture hardly changes.
Finding find_blur(const Planning& frame, double size, const BlurMoments& blur, const char* what) {
    if (size == 0.0) return skip("nothing is blurred");
    Finding finding = simulate(fmt::format("{} up to {:.3g} pixels", what, size));
    if (!frame.visible || !(size < half_pixel)) return finding;
    const double radiance = bound_blur(blur, frame.settings.picture.filter) * largest_contrast(frame);
    finding.cheaper = {.decision = Decision::skip,
                       .reason = fmt::format("{} by {:.2g} pixels", what, size),
                       .bound = frame.bound_of(radiance, frame.scene.environment.image != no_index)};
    return finding;
}

Finding find_motion_blur(Planning& frame) {
    const ShutterFacts& shutter = frame.in.shutter;
    if (!shutter.open) return skip("the shutter opens for no time");
    if (!shutter.changes) return skip("nothing changes while the shutter is open");
    if (shutter.blur) return find_blur(frame, shutter.largest, *shutter.blur, "the camera moves the picture");
    return simulate("objects, lights or reflections may change while the shutter is open");
}

Finding find_depth_of_field(Planning& frame) {
    const LensFacts& lens = frame.in.lens;
    if (!(lens.radius > 0.0)) return skip("the aperture is 0");
    const double radius = 0.5 * lens.circle;
    return find_blur(frame, lens.circle, {radius * 2.0 / 3.0, 0.0, 0.5 * radius * radius}, "circles of confusion");
}

constexpr const char* not_perceived = "nothing obeys the model of vision";

Finding find_motion(Planning& frame) {
    const PlanInput& in = frame.in;
    if (!in.perceives) return skip(not_perceived);
    if (!in.has_other) return skip("there is no other frame in this shot");
    if (in.moves) return simulate("objects or the camera move");
    return simulate_if(picture_search(frame.settings.guide.motion).has_value(), "it is found from pictures",
                       "nothing moves into the next frame");
}

Finding find_saliency(Planning& frame) {
    const PlanInput& in = frame.in;
    if (!in.perceives) return skip(not_perceived);
    if (frame.settings.perception.guide != Guide::saliency) return skip("the guide is not saliency");
    if (in.maps) return simulate("its map is asked for");
    if (frame.plan.skips(Effect::motion)) return skip("nothing moves, so it does not matter where viewers look");
    return simulate("viewers track what stands out");
}

void guide_without_saliency(RenderSettings& settings) {
    if (settings.perception.guide == Guide::saliency) settings.perception.guide = Guide::full;
}

constexpr Rgb red{1.0f, 0.1f, 0.1f}, cyan{0.0f, 0.8f, 0.9f};

}  // namespace

EffectTable view_effects() {
    return {
        {describe(Effect::motion_blur), find_motion_blur, red},
        {describe(Effect::depth_of_field), find_depth_of_field, cyan},
        {describe(Effect::motion), find_motion},
        {.effect = describe(Effect::saliency), .find = find_saliency, .turn_off = guide_without_saliency},
    };
}

}  // namespace aleph
