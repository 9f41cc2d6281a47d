#include "render/frame/frame_window.h"

#include "render/guide/error_report.h"
#include "render/guide/stopping_rule.h"

namespace aleph {

namespace {

void cut_motion(MotionField& motion, const auto& cut) {
    cut(motion.displacement, motion.path_length, motion.validity);
}

void cut_shaded(ShadedFrame& shaded, const auto& cut) {
    cut(shaded.records, shaded.invalid_samples, shaded.color, shaded.indirect, shaded.coverage, shaded.samples,
        shaded.variance, shaded.cache_count, shaded.cache_radius, shaded.errors.total);
    for (Image<float>& errors : shaded.errors.by_cause) cut(errors);
}

void cut_maps(PerceptionMaps& maps, const auto& cut) {
    cut(maps.aleph, maps.adaptation, maps.retinal_velocity, maps.saliency, maps.conspicuity_intensity,
        maps.conspicuity_color, maps.conspicuity_orientation, maps.conspicuity_motion);
    for (Image<float>& band : maps.responses) cut(band);
    for (Image<float>& band : maps.elevations) cut(band);
}

}  // namespace

PicturePart choose_window_part(const RenderSettings& settings, double pixels_per_degree, const PictureArea& window) {
    const Sampling rule = settings.sampling.rule;
    const int around = rule == Sampling::threshold ? 2 * find_seen_reach(pixels_per_degree)
                       : rule == Sampling::uniform ? 0
                                                   : 1;
    PicturePart part(settings.picture.width, settings.picture.height, std::uint8_t{0});
    mark_area(part, window, around);
    return part;
}

void cut_to_window(FrameOutput& output, const PictureArea& window) {
    const auto cut = [&window](auto&... images) {
        const auto cut_one = [&window](auto& image) {
            if (!image.empty()) image = crop(image, window);
        };
        (cut_one(images), ...);
    };
    cut(output.hits, output.estimate, output.velocity);
    cut(output.limits.alpha, output.limits.threshold, output.limits.threshold_noise);
    cut(output.surface.albedo, output.surface.depth, output.surface.normal, output.surface.effects);
    cut_motion(output.motion, cut);
    cut_motion(output.backward, cut);
    cut_maps(output.perception, cut);
    cut_shaded(output.shaded, cut);
    output.statistics.window = window;
    if (output.statistics.error)
        output.statistics.error = output.shaded.error_shares =
            count_errors(output.shaded.errors, output.shaded.error_shares.asked);
}

}  // namespace aleph
