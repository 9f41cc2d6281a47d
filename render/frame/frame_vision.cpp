#include "render/frame/frame_vision.h"

#include "perception/threshold.h"
#include "perception/visible_bands.h"
#include "render/guide/accuracy_map.h"

namespace aleph {

void note_estimate(FrameOutput& out, const SanitizeCounts& sanitized, const ViewingConditions& viewing) {
    out.statistics.estimate.sanitized = sanitized;
    out.statistics.estimate.median_luminance = median_luminance(out.estimate, viewing);
}

namespace {

/// Returns whether the eye follows what moves; else all of the picture is judged as if it stood still.
bool follows_motion(Guide guide) {
    return guide == Guide::full || guide == Guide::saliency;
}

/// The luminance of the display that the eye is adapted to, cd/m2: it emits no more than its white.
Image<float> find_shown_luminance(Image<Rgb> picture, const ViewingConditions& viewing) {
    for (Rgb& value : picture.pixels) value = glm::clamp(value, Rgb(0.0f), Rgb(1.0f));
    Image<float> shown = compute_adaptation_luminance(picture, viewing);
    for (float& value : shown.pixels) value += screen_reflection;
    return shown;
}

}  // namespace

void compute_frame_vision(FrameOutput& out, const Scene& shot, const RenderSettings& settings,
                          const NoiseVisibility& noise, bool maps, StageClock& clock) {
    StageSeconds& seconds = out.statistics.seconds;
    out.perception =
        compute_perception(out.estimate, out.velocity, shot.film.viewing, shot.film.frame_rate, settings.perception,
                           {.retinal_velocity = true, .conspicuity = maps, .bands = false});
    out.statistics.estimate.saliency_fallback = out.perception.fallback;
    Image<float>& adaptation = out.perception.adaptation;
    if (adaptation.empty()) adaptation = compute_adaptation_luminance(out.estimate, shot.film.viewing);
    out.limits.threshold = compute_threshold(out.perception.aleph, adaptation, *settings.perception.vision);
    // Noise is seen on the display: a lamp there is no brighter than white.
    const Image<float> shown = find_shown_luminance(out.estimate, shot.film.viewing);
    out.limits.threshold_noise = compute_noise_threshold(
        noise, out.estimate, shot.film.viewing.display_white, shown, out.perception.retinal_velocity,
        follows_motion(settings.perception.guide) ? out.velocity : Image<float>());
    out.limits.alpha = compute_accuracy_map(out.perception.aleph, settings);
    clock.add_to(seconds.perception);
}

}  // namespace aleph
