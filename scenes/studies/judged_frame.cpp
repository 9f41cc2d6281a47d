#include "scenes/studies/judged_frame.h"

#include <fmt/format.h>

#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"

namespace aleph {

JudgedFrame make_judged_frame(const Scene& scene, const RenderSettings& settings, std::int64_t number,
                              const std::string& file, const ReferencePictureOptions& reference,
                              std::vector<double> multiples, bool quiet) {
    JudgedFrame frame{.scene = scene,
                      .settings = settings,
                      .number = number,
                      .name = fmt::format("{} {}", scene_name(file), number),
                      .multiples = std::move(multiples)};
    Sequence viewer = make_vision_sequence(scene, settings, Guide::saliency, settings.perception.vision);
    FrameVision vision = compute_vision(viewer, number);
    frame.threshold = std::move(vision.threshold);
    frame.map_seconds = vision.seconds;
    frame.reference = load_or_render_reference_picture(scene, settings, number, file, reference, quiet);
    return frame;
}

RenderSettings judged_settings(const Scene& scene, const std::string& file, const std::string& size,
                               const std::vector<std::string>& sets) {
    const RenderSettings settings = scene_settings(scene, file, size, sets);
    return has_setting("filter") ? with_choice(settings, "filter", "box") : settings;
}

}  // namespace aleph
