// golden_page NEW REFERENCE NAME...: writes NEW/review.html, which shows NEW/NAME.exr, REFERENCE/NAME.exr and their
// difference with its numbers; its pictures are in NEW, too. A reference may be missing.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <limits>

#include "render/compare/compare.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// Writes the picture and returns an element that shows it on a page in its folder.
std::string figure(const fs::path& file, const Image<Rgb>& picture, const std::string& caption) {
    write_png(file, picture);
    return fmt::format("<figure><img src=\"{}\"><figcaption>{}</figcaption></figure>\n", file.filename().string(),
                       caption);
}

/// Least and largest finite value.
std::pair<float, float> range_of(const Image<float>& image) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float v : image.pixels) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    return {low, high};
}

/// A channel as grey; the range becomes 0 to 1, magenta is not finite.
Image<Rgb> grey(const Image<float>& image, std::pair<float, float> range) {
    Image<Rgb> picture(image.width, image.height);
    const float scale = range.second > range.first ? 1.0f / (range.second - range.first) : 0.0f;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const float v = image.pixels[i];
        picture.pixels[i] = std::isfinite(v) ? Rgb((v - range.first) * scale) : Rgb(1.0f, 0.0f, 1.0f);
    }
    return picture;
}

struct Pictures {
    const ChannelImage* fresh;
    const ChannelImage* reference;  ///< null if there is none
    fs::path base;                  ///< of the files, without an extension
};

/// R, G and B together, or one other channel: new, reference and difference.
std::string panels(const Pictures& pictures, const std::string& channel) {
    const bool colour = channel.empty();
    const fs::path base = pictures.base.string() + (colour ? "" : "." + channel);
    const auto file = [&](const char* which) { return base.string() + "." + which + ".png"; };
    const auto range = colour ? std::pair(0.0f, 0.0f)
                              : range_of(*(pictures.reference ? pictures.reference : pictures.fresh)->find(channel));
    const auto shown = [&](const ChannelImage& image) {
        return colour ? linear_colour(image) : grey(*image.find(channel), range);
    };
    std::string html = "<div>" + figure(file("new"), shown(*pictures.fresh), "new");
    if (pictures.reference) {
        CompareSettings settings;
        if (!colour) settings.channels = {channel};
        html += figure(file("reference"), shown(*pictures.reference), "reference");
        html += figure(file("difference"), difference_picture(*pictures.fresh, *pictures.reference, settings),
                       "difference (white: the largest)");
    }
    return html + "</div>\n";
}

std::string numbers(const CompareResult& result) {
    std::string html = "<table><tr><th>channel<th>max<th>at x,y<th>RMS<th>relative MSE</tr>\n";
    for (const ChannelDifference& c : result.channels) {
        html += fmt::format("<tr><td>{}<td>{:.4g}<td>{},{}<td>{:.4g}<td>{:.4g}</tr>\n", c.name, c.difference.max_abs,
                            c.x, c.y, c.difference.rms, c.difference.relative_mse);
    }
    return html + fmt::format("</table><p>NaN: {} and {}; infinite: {} and {}</p>\n", result.a.nan, result.b.nan,
                              result.a.inf, result.b.inf);
}

std::string section(const std::string& name, const fs::path& fresh_folder, const fs::path& reference_folder) {
    const ChannelImage fresh = read_image(fresh_folder / (name + ".exr"));
    const fs::path reference_file = reference_folder / (name + ".exr");
    const bool known = fs::exists(reference_file);
    const ChannelImage reference = known ? read_image(reference_file) : ChannelImage{};
    std::string html = fmt::format("<h2>{}</h2>\n", name);
    bool comparable = known;
    try {
        if (known) html += numbers(compare_images(fresh, reference));
    } catch (const std::exception& e) {
        html += fmt::format("<p>not comparable: {}</p>\n", e.what());
        comparable = false;
    }
    if (!known) html += "<p>new: no reference yet</p>\n";
    const Pictures pictures{&fresh, comparable ? &reference : nullptr, fresh_folder / name};
    const bool colour = !linear_colour(fresh).empty();
    if (colour) html += panels(pictures, "");
    for (const Channel& channel : fresh.channels) {
        if (colour && (channel.name == "R" || channel.name == "G" || channel.name == "B")) continue;
        html += fmt::format("<h3>{}</h3>\n", channel.name) + panels(pictures, channel.name);
    }
    return html;
}

void write_page(const fs::path& fresh, const fs::path& reference, const std::vector<std::string>& names) {
    std::string html =
        "<!DOCTYPE html><meta charset=\"utf-8\"><title>Golden images</title>\n"
        "<style>body{font:15px sans-serif;background:#ddd}div{display:flex;gap:8px}figure{margin:4px}"
        "img{width:420px;image-rendering:pixelated}td,th{padding:0 12px;text-align:right}</style>\n"
        "<h1>Golden images: new, reference, difference</h1>\n"
        "<p>If the change is right: <code>tests/golden/golden.sh accept</code></p>\n";
    for (const std::string& name : names) html += section(name, fresh, reference);
    write_file(fresh / "review.html", html);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    if (argc < 4) {
        std::cerr << "usage: golden_page NEW REFERENCE NAME...\n";
        return 2;
    }
    try {
        aleph::write_page(argv[1], argv[2], {argv + 3, argv + argc});
    } catch (const std::exception& e) {
        std::cerr << "golden_page: " << e.what() << "\n";
        return 1;
    }
}
