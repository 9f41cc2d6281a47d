#include "scenes/studies/study_tools.h"

#include <cmath>

#include "engine/image/image_file.h"

namespace aleph {

namespace {

/// Empty if the file has no R, G and B.
Image<Rgb> read_color(const std::filesystem::path& file) {
    const ChannelImage read = read_image(file);
    const Image<float>*r = read.find("R"), *g = read.find("G"), *b = read.find("B");
    if (r == nullptr || g == nullptr || b == nullptr) return {};
    Image<Rgb> color(r->width, r->height);
    for (std::size_t i = 0; i < color.size(); ++i) color.pixels[i] = Rgb(r->pixels[i], g->pixels[i], b->pixels[i]);
    return color;
}

void write_color(const std::filesystem::path& file, const Image<Rgb>& color) {
    ChannelImage written;
    for (int c = 0; c < 3; ++c) {
        Image<float> channel(color.width, color.height);
        for (std::size_t i = 0; i < color.size(); ++i) channel.pixels[i] = color.pixels[i][c];
        written.channels.push_back({std::string(1, "RGB"[c]), std::move(channel)});
    }
    write_exr(file, written);
}

}  // namespace

FrameOutput render_variant(const Scene& scene, RenderSettings settings, std::int64_t frame, Guide guide,
                           double accuracy, bool maps) {
    settings.perception.guide = guide;
    settings.accuracy = accuracy;
    FrameRequest request;
    request.maps = maps;
    return Sequence(scene, settings).render(frame, request);
}

ErrorFigures measure_error(const Image<Rgb>& color, const Image<Rgb>& dense, const Image<float>& threshold,
                           double display_white) {
    double mean = 0.0;
    for (const Rgb& pixel : dense.pixels) mean += luminance(pixel);
    mean /= static_cast<double>(dense.size());
    const double e2 = 1e-4 * mean * mean;
    ErrorFigures figures;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < dense.size(); ++i) {
        const double y = luminance(color.pixels[i]), r = luminance(dense.pixels[i]);
        figures.relative_mse += (y - r) * (y - r) / (r * r + e2);
        if (display_white * std::abs(y - r) > threshold.pixels[i]) ++beyond;
    }
    figures.relative_mse /= static_cast<double>(dense.size());
    figures.percent_beyond = 100.0 * static_cast<double>(beyond) / static_cast<double>(dense.size());
    return figures;
}

std::string guide_name(Guide guide) {
    RenderSettings settings;
    settings.perception.guide = guide;
    return std::get<std::string>(setting_map(settings).at("guide"));
}

Image<Rgb> load_or_render_dense(const Scene& scene, RenderSettings settings, std::int64_t frame, int gather,
                                const std::filesystem::path& file) {
    if (!file.empty() && std::filesystem::exists(file)) {
        const Image<Rgb> color = read_color(file);
        if (color.width == settings.width && color.height == settings.height) return color;
    }
    settings.gather = gather;
    const Image<Rgb> color = render_variant(scene, settings, frame, Guide::none, 0.0).shaded.color;
    if (!file.empty()) write_color(file, color);
    return color;
}

}  // namespace aleph
