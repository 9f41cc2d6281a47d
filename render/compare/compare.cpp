#include "render/compare/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/base/errors.h"

namespace aleph {

namespace {

struct ChannelPair {
    std::string name;
    const Image<float>* a;
    const Image<float>* b;
};

/// How certain a picture is.
bool is_certainty(const std::string& channel) {
    return channel == "variance.Y" || channel.starts_with("error.");
}

constexpr std::array<std::string_view, 5> count_names = {"samples.Y", "records.Y", "invalid.Y", "cache.count",
                                                         "cache.radius"};

/// Channels of `other` that have to be in `image` too, and are not.
std::vector<std::string> missing_in(const ChannelImage& image, const ChannelImage& other) {
    std::vector<std::string> names;
    for (const Channel& channel : other.channels) {
        const bool optional =
            is_certainty(channel.name) || std::ranges::find(count_names, channel.name) != count_names.end();
        if (!optional && !image.find(channel.name)) names.push_back(printable(channel.name));
    }
    return names;
}

std::vector<ChannelPair> match_all(const ChannelImage& a, const ChannelImage& b) {
    const auto only_a = missing_in(b, a), only_b = missing_in(a, b);
    if (!only_a.empty() || !only_b.empty()) {
        throw InputError(
            "", "",
            fmt::format("the pictures differ in channels: only the first has [{}], only the second [{}]; --channels "
                        "names those to compare",
                        fmt::join(only_a, ", "), fmt::join(only_b, ", ")));
    }
    std::vector<ChannelPair> pairs;
    for (const Channel& channel : b.channels) {
        const Image<float>* in_a = a.find(channel.name);
        if (in_a && !is_certainty(channel.name)) pairs.push_back({channel.name, in_a, &channel.values});
    }
    if (pairs.empty()) throw InputError("", "", "the pictures have no channel in common");
    return pairs;
}

/// The channels of both pictures, those with one prefix once: the names that --channels takes.
std::vector<std::string> common_names(const ChannelImage& a, const ChannelImage& b) {
    std::vector<std::string> names;
    for (const Channel& channel : b.channels) {
        const std::string name = printable(channel.name.substr(0, channel.name.find('.')));
        if (a.find(channel.name) && std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    return names;
}

/// The channels that are compared, in the order of b.
/// @param wanted  CompareSettings::channels
std::vector<ChannelPair> match_channels(const ChannelImage& a, const ChannelImage& b,
                                        const std::vector<std::string>& wanted) {
    check_sizes(a, b);
    if (wanted.empty()) return match_all(a, b);
    std::vector<ChannelPair> pairs;
    for (const std::string& name : wanted) {
        bool found = false;
        for (const Channel& channel : b.channels) {
            const Image<float>* in_a = a.find(channel.name);
            const bool is_named = channel.name == name || channel.name.starts_with(name + ".");
            if (!is_named || !in_a) continue;
            found = true;
            if (std::ranges::find(pairs, channel.name, &ChannelPair::name) == pairs.end()) {
                pairs.push_back({channel.name, in_a, &channel.values});
            }
        }
        if (!found)
            throw InputError(
                "", fmt::format("channel '{}'", printable(name)),
                fmt::format("is not in both pictures; both have [{}]", fmt::join(common_names(a, b), ", ")));
    }
    return pairs;
}

/// R, G and B among the pairs, in this order; empty if one is missing.
std::vector<ChannelPair> colour_pairs(const std::vector<ChannelPair>& pairs) {
    std::vector<ChannelPair> colour;
    for (const char* name : {"R", "G", "B"}) {
        const auto found = std::ranges::find(pairs, name, &ChannelPair::name);
        if (found != pairs.end()) colour.push_back(*found);
    }
    return colour.size() == 3 ? colour : std::vector<ChannelPair>{};
}

/// Calls visit(i, a, b) for the finite values of a pair.
void for_finite(const ChannelPair& pair, const auto& visit) {
    for (std::size_t i = 0; i < pair.a->size(); ++i) {
        const double a = pair.a->pixels[i], b = pair.b->pixels[i];
        if (std::isfinite(a) && std::isfinite(b)) visit(i, a, b);
    }
}

void count_non_finite(const Image<float>& image, NonFinite& counts) {
    for (const float v : image.pixels) {
        counts.nan += std::isnan(v);
        counts.inf += std::isinf(v);
    }
}

Difference difference_of(const std::vector<ChannelPair>& pairs) {
    std::size_t count = 0;
    double sum = 0.0, squares = 0.0;
    for (const ChannelPair& pair : pairs) {
        for_finite(pair, [&](std::size_t, double, double b) {
            sum += std::abs(b);
            ++count;
        });
    }
    const double n = static_cast<double>(std::max<std::size_t>(count, 1)), e = 0.01 * sum / n;
    Difference all;
    for (const ChannelPair& pair : pairs) {
        for_finite(pair, [&](std::size_t, double a, double b) {
            const double d = std::abs(a - b);
            all.max_abs = std::max(all.max_abs, d);
            squares += d * d;
            if (d > 0.0) all.relative_mse += d * d / (b * b + e * e);  // infinite if b is 0 everywhere
        });
    }
    all.rms = std::sqrt(squares / n);
    all.relative_mse /= n;
    return all;
}

ChannelDifference compare_channel(const ChannelPair& pair, const CompareSettings& settings, std::vector<bool>& beyond) {
    ChannelDifference result{pair.name, difference_of({pair}), 0, 0, 0};
    double worst = -1.0;
    for_finite(pair, [&](std::size_t i, double a, double b) {
        const double d = std::abs(a - b);
        if (d > worst) {
            worst = d;
            const auto width = static_cast<std::size_t>(pair.b->width);
            result.x = static_cast<int>(i % width);
            result.y = static_cast<int>(i / width);
        }
        if (d > settings.tolerance + settings.relative * std::abs(b)) {
            ++result.beyond;
            beyond[i] = true;
        }
    });
    return result;
}

ThresholdDifference compare_with_threshold(const ChannelImage& a, const ChannelImage& b,
                                           const ChannelImage& aleph_map) {
    const Image<float>* threshold = aleph_map.find("threshold.Y");
    if (!threshold) throw InputError("", "threshold map", "has no channel 'threshold.Y'");
    const LuminanceError error = compute_luminance_error(a, b);
    return {measure_error(error, *threshold), error.display_white};
}

std::vector<std::string> exceeded_limits(const CompareResult& result, const CompareSettings& settings) {
    std::vector<std::string> exceeded;
    const auto limit = [&](const char* name, double value, double most) {
        if (!(value <= most)) exceeded.emplace_back(name);
    };
    limit("share", result.percent(result.threshold ? result.threshold->beyond : result.counted), settings.share);
    limit("max_error", result.all.max_abs, settings.max_error);
    double rms = 0.0;
    for (const ChannelDifference& channel : result.channels) rms = std::max(rms, channel.difference.rms);
    limit("max_rms", rms, settings.max_rms);
    if (result.luminance) {
        const LuminanceDifference& luminance = *result.luminance;
        limit("max_relative_mse", luminance.without_noise(), settings.max_relative_mse);
        limit("max_bias", 100.0 * std::abs(luminance.bias), settings.max_bias);
    }
    return exceeded;
}

void refuse_limits_without_luminance(const CompareResult& result, const CompareSettings& settings) {
    const bool wanted = settings.max_relative_mse < unlimited || settings.max_bias < unlimited;
    if ((wanted || settings.standard_errors) && !result.luminance) {
        throw InputError("", "", "limits of bias, relative MSE and standard errors need pictures with R, G and B");
    }
    if (settings.standard_errors && !result.luminance->has_variance) {
        throw InputError("", "", "limits in standard errors need a picture with the channel variance.Y");
    }
}

}  // namespace

CompareResult compare_images(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings,
                             const ChannelImage* aleph_map) {
    // Where only one is encoded, it is decoded.
    if (is_encoded(a) && !is_encoded(b)) return compare_images(decode_colour(a), b, settings, aleph_map);
    if (is_encoded(b) && !is_encoded(a)) return compare_images(a, decode_colour(b), settings, aleph_map);
    const std::vector<ChannelPair> pairs = match_channels(a, b, settings.channels);
    CompareResult result;
    result.width = pairs.front().b->width;
    result.height = pairs.front().b->height;
    std::vector<bool> beyond(result.pixels(), false);
    for (const ChannelPair& pair : pairs) {
        result.channels.push_back(compare_channel(pair, settings, beyond));
        count_non_finite(*pair.a, result.a);
        count_non_finite(*pair.b, result.b);
    }
    result.beyond = static_cast<std::size_t>(std::count(beyond.begin(), beyond.end(), true));
    result.all = difference_of(pairs);
    if (const auto colour = colour_pairs(pairs); !colour.empty()) {
        result.colour = difference_of(colour);
        result.luminance =
            compare_luminance(a, b, {settings.tolerance, settings.relative, settings.standard_errors.value_or(3.0)});
    }
    refuse_limits_without_luminance(result, settings);
    if (aleph_map) result.threshold = compare_with_threshold(a, b, *aleph_map);
    result.counted = settings.standard_errors ? result.luminance->far : result.beyond;
    result.exceeded = exceeded_limits(result, settings);
    return result;
}

Image<Rgb> difference_picture(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings) {
    if (is_encoded(a) && !is_encoded(b)) return difference_picture(decode_colour(a), b, settings);
    if (is_encoded(b) && !is_encoded(a)) return difference_picture(a, decode_colour(b), settings);
    const std::vector<ChannelPair> pairs = match_channels(a, b, settings.channels);
    const std::vector<ChannelPair> colour = colour_pairs(pairs);
    Image<Rgb> picture(pairs.front().b->width, pairs.front().b->height, Rgb(0.0f));
    float largest = 0.0f;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
        if (!colour.empty() && c > 2) break;
        for_finite(colour.empty() ? pairs[c] : colour[c], [&](std::size_t i, double va, double vb) {
            const auto d = static_cast<float>(std::abs(va - vb));
            largest = std::max(largest, d);
            Rgb& pixel = picture.pixels[i];
            if (colour.empty()) {
                pixel = Rgb(std::max(pixel.x, d));
            } else {
                pixel[static_cast<int>(c)] = d;
            }
        });
    }
    if (largest > 0.0f) {
        for (Rgb& pixel : picture.pixels) pixel /= largest;
    }
    for (const ChannelPair& pair : pairs) {
        for (std::size_t i = 0; i < picture.size(); ++i) {
            if (!std::isfinite(pair.a->pixels[i]) || !std::isfinite(pair.b->pixels[i])) {
                picture.pixels[i] = Rgb(1.0f, 0.0f, 1.0f);
            }
        }
    }
    return picture;
}

}  // namespace aleph
