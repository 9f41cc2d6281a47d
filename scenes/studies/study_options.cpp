#include "scenes/studies/study_options.h"

#include "render/cli/options.h"

namespace aleph {

void add_study_options(CLI::App& app, StudyOptions& options) {
    app.add_option("--size", options.size, "WIDTHxHEIGHT of the frames")->capture_default_str();
    if (!options.picture.empty())
        app.add_option("-o,--output", options.picture, "the picture, .png or .jpg")->capture_default_str();
    add_value(app, "--gather", options.gather, "rays per irradiance value");
    add_value(app, "--spp", options.spp, "samples per pixel");
    add_value(app, "-t,--threads", options.threads, "threads; 0: all");
}

RenderSettings study_settings(const Scene& scene, const std::string& file, const StudyOptions& options) {
    RenderSettings settings;
    apply_settings(settings, scene.settings, file);
    parse_size(options.size, "--size", settings.width, settings.height);
    settings.gather = options.gather;
    settings.spp = options.spp;
    return settings;
}

}  // namespace aleph
