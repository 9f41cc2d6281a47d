#include "render/compare/compare_luminance.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/base/errors.h"
#include "engine/base/pixel_loops.h"
#include "engine/base/viewing.h"

namespace aleph {

namespace {

struct Colours {
    Image<Rgb> a, b;
};

Colours colours_of(const ChannelImage& a, const ChannelImage& b) {
    Colours colours{linear_colour(a), linear_colour(b)};
    if (colours.a.empty() || colours.b.empty()) throw InputError("", "luminance", "needs pictures with R, G and B");
    check_sizes(a, b);
    return colours;
}

/// Variance of a pixel, 0 if the picture has none; infinite if it is not a variance.
double variance_at(const Image<float>* variance, std::size_t i) {
    if (!variance) return 0.0;
    const double v = variance->pixels[i];
    return v >= 0.0 ? v : std::numeric_limits<double>::infinity();
}

/// Luminance of what a display shows, white = 1. Light below 0 is an error, whatever a display makes of it.
double shown_luminance(const Rgb& color) {
    return luminance(glm::min(color, 1.0f));
}

/// The part of a pixel's variance that a display shows: the squared half of what one standard error more and less show,
/// all of it below white.
double shown_variance(const Rgb& color, double variance) {
    const double y = luminance(color), step = std::sqrt(variance) / y;
    const bool is_below = std::max({color.x, color.y, color.z}) * (1.0 + step) <= 1.0;
    if (is_below || !(variance >= 0.0 && y > 0.0 && std::isfinite(step))) return variance;
    const auto shown = [&](double factor) { return double{luminance(Rgb(glm::min(glm::dvec3(color) * factor, 1.0)))}; };
    const double deviation = 0.5 * (shown(1.0 + step) - shown(1.0 - step));
    return deviation * deviation;
}

}  // namespace

void check_sizes(const ChannelImage& a, const ChannelImage& b) {
    if (a.channels.empty() || b.channels.empty()) throw InputError("", "", "a picture has no channels");
    const Image<float>& size_a = a.channels.front().values;
    const Image<float>& size_b = b.channels.front().values;
    if (!same_size(size_a, size_b)) {
        throw InputError("", "",
                         fmt::format("the pictures differ in size: {}x{} and {}x{}", size_a.width, size_a.height,
                                     size_b.width, size_b.height));
    }
}

std::optional<double> find_number(const ChannelImage& image, const std::string& key) {
    const auto found = image.metadata.find(key);
    const double* const number = found == image.metadata.end() ? nullptr : std::get_if<double>(&found->second);
    return number && std::isfinite(*number) && *number > 0.0 ? std::optional(*number) : std::nullopt;
}

Image<Rgb> join_channels(const ChannelImage& image, const std::string& prefix) {
    const Image<float>*r = image.find(prefix + "R"), *g = image.find(prefix + "G"), *b = image.find(prefix + "B");
    if (!r || !g || !b) return {};
    return map_pixels([](float red, float green, float blue) { return Rgb(red, green, blue); }, *r, *g, *b);
}

bool is_encoded(const ChannelImage& image) {
    return image.metadata.contains("encoding");
}

ChannelImage decode_colour(ChannelImage image) {
    image.metadata.erase("encoding");
    for (Channel& channel : image.channels) {
        if (channel.name == "A") continue;
        for (float& value : channel.values.pixels) value = srgb_to_linear(value);
    }
    return image;
}

Image<Rgb> linear_colour(const ChannelImage& image) {
    if (is_encoded(image)) return join_channels(decode_colour(image), "");
    return join_channels(image, "");
}

double display_white_of(const ChannelImage& a, const ChannelImage& b) {
    const double otherwise = find_number(a, "whiteLuminance").value_or(ViewingConditions{}.display_white);
    return find_number(b, "whiteLuminance").value_or(otherwise);
}

LuminanceError compute_luminance_error(const ChannelImage& a, const ChannelImage& b) {
    const Colours colours = colours_of(a, b);
    LuminanceError result{.error = {}, .variance = {}, .display_white = display_white_of(a, b)};
    const double white = result.display_white;
    result.error = map_pixels(
        [&](const Rgb& ca, const Rgb& cb) {
            return is_finite(ca) && is_finite(cb) ? white * (shown_luminance(ca) - shown_luminance(cb))
                                                  : std::numeric_limits<double>::quiet_NaN();
        },
        colours.a, colours.b);
    if (const Image<float>* variance = b.find("variance.Y"))
        result.variance = map_pixels(
            [&](const Rgb& color, float v) { return white * white * shown_variance(color, v); }, colours.b, *variance);
    return result;
}

LuminanceDifference compare_luminance(const ChannelImage& a, const ChannelImage& b,
                                      const LuminanceTolerance& tolerance) {
    const Colours colours = colours_of(a, b);
    const Image<float>*variance_a = a.find("variance.Y"), *variance_b = b.find("variance.Y");
    LuminanceDifference result;
    result.has_variance = variance_a || variance_b;
    const auto for_pixels = [&](const auto& visit) {
        for (std::size_t i = 0; i < colours.b.size(); ++i) {
            const double ya = luminance(colours.a.pixels[i]), yb = luminance(colours.b.pixels[i]);
            if (std::isfinite(ya) && std::isfinite(yb)) visit(i, ya, yb);
        }
    };
    double sum_b = 0.0, sum_abs_b = 0.0, sum_d = 0.0, sum_variance = 0.0;
    std::size_t count = 0;
    for_pixels([&](std::size_t i, double ya, double yb) {
        ++count;
        sum_b += yb;
        sum_abs_b += std::abs(yb);
        sum_d += ya - yb;
        sum_variance += variance_at(variance_a, i) + variance_at(variance_b, i);
    });
    if (count == 0) return result;
    const auto n = static_cast<double>(count);
    if (sum_d != 0.0) result.bias = sum_d / sum_b;
    if (sum_variance > 0.0) result.bias_error = std::sqrt(sum_variance) / std::abs(sum_b);
    const double e = 0.01 * sum_abs_b / n;
    for_pixels([&](std::size_t i, double ya, double yb) {
        const double d = std::abs(ya - yb), scale = yb * yb + e * e, noise = variance_at(variance_b, i);
        if (d > 0.0) result.relative_mse += d * d / scale / n;
        if (noise > 0.0) result.noise_mse += noise / scale / n;
        const double deviation = std::sqrt(variance_at(variance_a, i) + noise);
        const double allowed = tolerance.absolute + tolerance.relative * std::abs(yb) +
                               (tolerance.standard_errors > 0.0 ? tolerance.standard_errors * deviation : 0.0);
        result.far += d > allowed;
    });
    return result;
}

}  // namespace aleph
