#include "render/output/map_preview.h"

#include <algorithm>
#include <cmath>

#include "render/output/sheet.h"

namespace aleph {

namespace {

constexpr int columns = 3;
constexpr double highest_elevation = 250.6;  // of the Aleph map: 1 over the least contrast sensitivity

constexpr int spacing = 12;           // pixels
constexpr double least_length = 1.0;  // pixels, of a line that is drawn
const Rgb line_color(1.0f, 0.75f, 0.0f), start_color(1.0f, 0.1f, 0.0f);

void put(Image<Rgb>& picture, double x, double y, const Rgb& color) {
    const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
    if (column >= 0 && row >= 0 && column < picture.width && row < picture.height) picture(column, row) = color;
}

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

void draw_motion(Image<Rgb>& picture, const MotionField& motion) {
    for (int y = spacing / 2; y < picture.height; y += spacing) {
        for (int x = spacing / 2; x < picture.width; x += spacing) {
            const glm::dvec2 way = motion.displacement(x, y) * static_cast<double>(motion_line_frames);
            const double length = std::hypot(way.x, way.y);
            if (!(length >= least_length)) continue;
            const int steps = static_cast<int>(std::ceil(length));  // at most the diagonal, times the frames
            for (int i = 0; i <= steps; ++i) {
                const double part = static_cast<double>(i) / steps;
                put(picture, x + way.x * part, y + way.y * part, line_color);
            }
            for (const int right : {0, 1})
                for (const int below : {0, 1}) put(picture, x + right, y + below, start_color);
        }
    }
}

}  // namespace aleph
