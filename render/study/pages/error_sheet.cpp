#include "render/study/pages/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/pixel_loops.h"
#include "render/compare/compare_luminance.h"
#include "render/compare/reference_passes.h"
#include "render/output/sheet.h"

namespace aleph {

namespace {

constexpr int least_width = 240;  // pixels, of a panel

Image<float> divide_error(const LuminanceError& error, const Image<float>& threshold) {
    return map_pixels([](double e, float t) { return static_cast<float>(std::abs(e) / t); }, error.error, threshold);
}

}  // namespace

void check_variant_name(const PreparedStudy& prepared, const std::string& variant) {
    std::string names;
    for (const StudyVariant& other : prepared.variants) {
        if (other.name == variant) return;
        names += (names.empty() ? "" : ", ") + other.name;
    }
    throw InputError("", "--errors",
                     "no variant is called " + printable(variant) + "; there are: " + printable(names, 400));
}

void write_error_sheet(const std::filesystem::path& path, const PreparedStudy& prepared, const StudyResults& results,
                       const std::vector<std::string>& variants) {
    std::vector<Panel> panels;
    for (std::size_t i = 0; i < results.frames.size(); ++i) {
        const JudgingFrame& frame = results.frames[i];
        for (const std::string& variant : variants) {
            const auto found = std::ranges::find(results.variants, variant, &VariantResult::name);
            const ChannelImage picture = read_image(found->frames.at(i).picture);
            const LuminanceError error =
                compute_luminance_error(picture, with_exposure_of(read_image(frame.reference), picture));
            const std::string name = variants.size() > 1 ? ": " + variant : "";
            panels.push_back(
                color_panel(fmt::format("{}, frame {}{}", frame.scene, frame.frame, name), linear_colour(picture)));
            for (std::size_t v = 0; v < frame.thresholds.size(); ++v) {
                panels.push_back(map_panel(fmt::format("error, {}", prepared.study.viewers[v].name),
                                           divide_error(error, frame.thresholds[v]), {0.1, 10.0, true}));
            }
        }
    }
    const std::size_t columns = variants.size() * (1 + prepared.study.viewers.size());
    write_sheet(path, panels, static_cast<int>(columns), std::max(least_width, panels.front().display.width));
}

}  // namespace aleph
