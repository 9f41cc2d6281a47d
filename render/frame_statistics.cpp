// The --stats file: counts and times of every frame as JSON.

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "engine/base/parallel.h"
#include "render/frame_files.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json frame_json(const FrameStatistics& f) {
    Json seconds = Json::object();
    for (const auto& [stage, value] : list_stages(f.seconds)) seconds[stage] = value;
    return {
        {"frame", f.frame},
        {"seconds", seconds},
        {"rays",
         {{"primary", f.rays.primary},
          {"shadow", f.rays.shadow},
          {"gather", f.rays.gather},
          {"glossy", f.rays.glossy},
          {"specular", f.rays.specular},
          {"path", f.rays.path},
          {"total", f.rays.total()},
          {"traced", f.traced_rays},
          {"invalid", f.invalid_rays}}},
        {"cache",
         {{"records", f.records}, {"lookups", f.cache.lookups}, {"hits", f.cache.hits}, {"rounds", f.cache.rounds}}},
        {"samples", f.samples},
        {"nan", f.nan_count},
        {"estimate", {{"replaced", f.replaced}, {"clamped", f.clamped}, {"median_cd_m2", f.median_luminance}}},
        {"saliency_fallback", f.saliency_fallback},
        {"instances_updated", f.instances_touched},
        {"peak_memory_mib", f.peak_memory_mib}};
}

}  // namespace

std::string format_statistics(const std::vector<FrameStatistics>& frames, const Scene& scene,
                              const RenderSettings& settings, double exposure) {
    Json json;
    json["schema_version"] = 1;
    json["scene"] = scene.file;
    json["frames"] = Json::array();
    for (const FrameStatistics& frame : frames) json["frames"].push_back(frame_json(frame));
    for (const auto& [key, value] : setting_map(settings)) {
        std::visit([&, k = key](const auto& v) { json["settings"][k] = v; }, value);
    }
    json["exposure"] = exposure;
    json["threads"] = thread_count();
    char host[256] = "";
    if (gethostname(host, sizeof host - 1) == 0) json["host"] = host;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aleph
