#include "render/output/map_preview.h"

#include "render/output/sheet.h"

namespace aleph {

namespace {

constexpr int columns = 3;
constexpr double highest_elevation = 250.6;  // of the Aleph map: 1 over the least contrast sensitivity

}  // namespace

void write_map_preview(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts) {
    std::vector<Panel> panels{color_panel("estimate", output.estimate)};
    const auto add = [&](const char* caption, const Image<float>& map, const MapRange& range) {
        if (!map.empty()) panels.push_back(map_panel(caption, map, range));
    };
    add("speed, deg/s", output.velocity, {0.1, 100.0, true});
    add("saliency", output.perception.saliency, {0.0, 1.0, false});
    add("Aleph map", output.perception.aleph, {1.0, highest_elevation, true});
    add("threshold, cd/m2", output.limits.threshold, {0.1, 100.0, true});
    add("accuracy", output.limits.alpha, {0.01, 1.0, true});
    write_sheet(path, panels, columns, output.estimate.width, texts);
}

}  // namespace aleph
