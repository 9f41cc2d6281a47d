// Which maps a report shows, and in which order they lead from a pixel's motion to its error.

#include <nlohmann/json.hpp>

#include "perception/vision/band_frequencies.h"
#include "render/study/pages/pages.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json channel(const char* name, const char* title, const char* unit) {
    return {{"name", name}, {"title", title}, {"unit", unit}};
}

Json step(const char* title, const char* text, Json channels) {
    return {{"title", title}, {"text", text}, {"channels", std::move(channels)}};
}

}  // namespace

Json report_maps() {
    struct Row {
        const char *name, *title, *unit, *scale;
    };
    constexpr Row rows[] = {
        {"threshold.Y", "visible threshold", "cd/m2", "log"},
        {"aleph.Y", "Aleph map: contrast elevation", "times", "log"},
        {"alpha.acc", "ambient accuracy", "", "log"},
        {"samples.Y", "samples", "per pixel", "log"},
        {"error.Y", "estimated error", "visible thresholds", "log"},
        {"error.edges", "estimated error of edges and textures", "visible thresholds", "log"},
        {"error.blur", "estimated error of motion blur and depth of field", "visible thresholds", "log"},
        {"error.direct", "estimated error of direct light", "visible thresholds", "log"},
        {"error.gloss", "estimated error of reflections", "visible thresholds", "log"},
        {"error.indirect", "estimated error of cached light", "visible thresholds", "log"},
        {"records.Y", "irradiance values computed here", "", "linear"},
        {"cache.count", "cache records used", "per sample", "linear"},
        {"cache.radius", "reach of the cache records", "m", "log"},
        {"velocity.image", "speed on the image", "degrees per second", "linear"},
        {"velocity.retinal", "speed on the retina", "degrees per second", "linear"},
        {"saliency.Y", "saliency", "", "linear"},
        {"conspicuity.intensity", "conspicuity of intensity", "", "linear"},
        {"conspicuity.color", "conspicuity of colour", "", "linear"},
        {"conspicuity.orientation", "conspicuity of orientation", "", "linear"},
        {"conspicuity.motion", "conspicuity of motion", "", "linear"},
        {"forward.u", "motion to the right", "pixels", "diverging"},
        {"forward.v", "motion upwards", "pixels", "diverging"},
        {"motion.valid", "validity of the motion", "", "category"},
    };
    Json maps = Json::array();
    for (const Row& row : rows)
        maps.push_back({{"name", row.name}, {"title", row.title}, {"unit", row.unit}, {"scale", row.scale}});
    return maps;
}

Json report_walk(const StudyResults& results) {
    Json frequencies = Json::array(), responses = Json::array(), elevations = Json::array();
    for (int i = 0; i < band_count; ++i) {
        if (!results.frames.empty())
            frequencies.push_back(results.frames.front().frequencies.at(static_cast<std::size_t>(i)));
        responses.push_back("band." + std::to_string(i));
        elevations.push_back("elevation." + std::to_string(i));
    }
    return Json::array(
        {step("Motion", "Where the surface point under the pixel goes in the next frame.",
              {channel("forward.u", "to the right", "pixels"), channel("forward.v", "upwards", "pixels"),
               channel("motion.valid", "validity", "")}),
         step("Velocity", "The eye follows what stands out; what it does not follow moves over the retina.",
              {channel("velocity.image", "on the image", "degrees per second"), channel("saliency.Y", "saliency", ""),
               channel("velocity.retinal", "on the retina", "degrees per second")}),
         {{"title", "Bands"},
          {"text",
           "The shares of spatial frequencies around the pixel, and how many times the least visible contrast "
           "goes unseen at each, because it moves."},
          {"bands", {{"frequency", frequencies}, {"channels", responses}, {"elevation", elevations}}}},
         step(
             "Aleph map", "The elevations weighted by the shares; with the luminance, the visible threshold.",
             {channel("aleph.Y", "contrast elevation", "times"), channel("threshold.Y", "visible threshold", "cd/m2")}),
         step(
             "Effort", "What the renderer spent here.",
             {channel("alpha.acc", "ambient accuracy", ""), channel("samples.Y", "samples", "per pixel"),
              channel("records.Y", "irradiance values computed", ""),
              channel("cache.count", "cache records used", "per sample"), channel("cache.radius", "their reach", "m")}),
         step("Estimated error", "What the renderer expected of its own error, by cause.",
              {channel("error.Y", "all", "visible thresholds"),
               channel("error.edges", "edges and textures", "visible thresholds"),
               channel("error.blur", "blur", "visible thresholds"),
               channel("error.direct", "direct light", "visible thresholds"),
               channel("error.gloss", "reflections", "visible thresholds"),
               channel("error.indirect", "cached light", "visible thresholds")})});
}

}  // namespace aleph
