#include "scenes/studies/judged_frame.h"

#include <fmt/format.h>

#include "engine/scene/scene_hash.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
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
    frame.reference = load_judged_reference(scene, settings, number, file, reference, quiet);
    return frame;
}

void add_reference_options(CLI::App& app, ReferencePictureOptions& options) {
    add_value(app, "--reference-passes", options.passes, "renderings that the reference is the mean of");
    add_value(app, "--reference-spp", options.pass_spp, "samples per pixel of each");
    app.add_option("--reference-kind", options.kind,
                   "how the reference is made: by traced paths, or by gathers without a cache")
        ->check(CLI::IsMember({"path", "gather"}))
        ->capture_default_str();
    app.add_option("--references", options.folder,
                   "folder for references, which are read if they exist; those with fewer passes get more")
        ->capture_default_str();
}

ChannelImage load_judged_reference(const Scene& scene, const RenderSettings& settings, std::int64_t frame,
                                   const std::string& file, ReferencePictureOptions options, bool quiet) {
    options.name = scene_name(file);
    options.identity = hash_scene(scene);
    Progress progress(fmt::format("reference of {} {}", options.name, frame), options.passes, progress_look(quiet));
    return load_or_render_reference_picture(scene, settings, frame, options,
                                            [&](double done) { progress.update(done); });
}

RenderSettings judged_settings(const Scene& scene, const std::string& file, const std::string& size,
                               const std::vector<std::string>& sets) {
    const RenderSettings settings = scene_settings(scene, file, size, sets);
    return has_setting("filter") ? with_choice(settings, "filter", "box") : settings;
}

}  // namespace aleph
