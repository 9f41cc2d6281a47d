#include "render/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/viewing.h"
#include "render/yee_metric.h"

namespace aleph {

namespace {

/// One channel of both pictures.
struct Pair {
    std::string name;
    const Image<float>* a;
    const Image<float>* b;
};

bool belongs_to(const std::string& channel, const std::string& wanted) {
    return channel == wanted || channel.starts_with(wanted + ".");
}

std::vector<std::string> missing_in(const ChannelImage& image, const ChannelImage& other) {
    std::vector<std::string> names;
    for (const Channel& channel : other.channels) {
        if (!image.find(channel.name)) names.push_back(printable(channel.name));
    }
    return names;
}

std::vector<Pair> matching_channels(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings) {
    if (a.channels.empty() || b.channels.empty()) throw InputError("", "", "a picture has no channels");
    const Image<float>& size_a = a.channels.front().values;
    const Image<float>& size_b = b.channels.front().values;
    if (!same_size(size_a, size_b)) {
        throw InputError("", "",
                         fmt::format("the pictures differ in size: {}x{} and {}x{}", size_a.width, size_a.height,
                                     size_b.width, size_b.height));
    }
    std::vector<Pair> pairs;
    if (settings.channels.empty()) {
        const auto only_a = missing_in(b, a), only_b = missing_in(a, b);
        if (!only_a.empty() || !only_b.empty()) {
            throw InputError("", "",
                             fmt::format("the pictures differ in channels: only the first has [{}], only the "
                                         "second [{}]",
                                         fmt::join(only_a, ", "), fmt::join(only_b, ", ")));
        }
        for (const Channel& channel : b.channels)
            pairs.push_back({channel.name, a.find(channel.name), &channel.values});
        return pairs;
    }
    for (const std::string& wanted : settings.channels) {
        bool found = false;
        for (const Channel& channel : b.channels) {
            const Image<float>* in_a = a.find(channel.name);
            if (!belongs_to(channel.name, wanted) || !in_a) continue;
            found = true;
            const bool known =
                std::any_of(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.name == channel.name; });
            if (!known) pairs.push_back({channel.name, in_a, &channel.values});
        }
        if (!found) throw InputError("", fmt::format("channel '{}'", printable(wanted)), "is not in both pictures");
    }
    return pairs;
}

/// Gathers a Difference in two passes: the scale of b first, as relative_mse needs it.
class DifferenceSum {
  public:
    void add_reference(double b) {
        sum_abs_b_ += std::abs(b);
        ++count_;
    }
    void finish_reference() { e_ = count_ ? 0.01 * sum_abs_b_ / static_cast<double>(count_) : 0.0; }
    /// Returns |a - b|.
    double add(double a, double b) {
        const double d = std::abs(a - b);
        max_ = std::max(max_, d);
        squares_ += d * d;
        if (d > 0.0) relative_ += d * d / (b * b + e_ * e_);  // infinite if b is 0 everywhere
        return d;
    }
    Difference result() const {
        const double n = static_cast<double>(std::max<std::size_t>(count_, 1));
        return {max_, std::sqrt(squares_ / n), relative_ / n};
    }

  private:
    std::size_t count_ = 0;
    double sum_abs_b_ = 0.0, e_ = 0.0, max_ = 0.0, squares_ = 0.0, relative_ = 0.0;
};

void count_non_finite(const Image<float>& image, NonFinite& counts) {
    for (const float v : image.pixels) {
        counts.nan += std::isnan(v);
        counts.inf += std::isinf(v);
    }
}

/// Calls visit(i, a, b) for the finite pairs of a channel.
template <class Visit>
void for_finite(const Pair& pair, const Visit& visit) {
    for (std::size_t i = 0; i < pair.a->size(); ++i) {
        const double a = pair.a->pixels[i], b = pair.b->pixels[i];
        if (std::isfinite(a) && std::isfinite(b)) visit(i, a, b);
    }
}

Difference difference_of(const std::vector<Pair>& pairs) {
    DifferenceSum sum;
    for (const Pair& pair : pairs) for_finite(pair, [&](std::size_t, double, double b) { sum.add_reference(b); });
    sum.finish_reference();
    for (const Pair& pair : pairs) for_finite(pair, [&](std::size_t, double a, double b) { sum.add(a, b); });
    return sum.result();
}

std::vector<Pair> colour_pairs(const std::vector<Pair>& pairs) {
    std::vector<Pair> colour;
    for (const char* name : {"R", "G", "B"}) {
        for (const Pair& pair : pairs) {
            if (pair.name == name) colour.push_back(pair);
        }
    }
    return colour.size() == 3 ? colour : std::vector<Pair>{};
}

ChannelDifference compare_channel(const Pair& pair, const CompareSettings& settings, std::vector<bool>& beyond) {
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

/// Linear R, G, B of a picture, or nothing if it has none.
Image<Rgb> linear_colour(const ChannelImage& image) {
    const Image<float>*r = image.find("R"), *g = image.find("G"), *b = image.find("B");
    if (!r || !g || !b) return {};
    const bool encoded = image.metadata.contains("encoding");
    Image<Rgb> colour(r->width, r->height);
    for (std::size_t i = 0; i < colour.size(); ++i) {
        Rgb c{r->pixels[i], g->pixels[i], b->pixels[i]};
        if (encoded) c = {srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z)};
        colour.pixels[i] = c;
    }
    return colour;
}

bool all_finite(const Image<Rgb>& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](const Rgb& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); });
}

double display_white(const ChannelImage& a, const ChannelImage& b) {
    for (const ChannelImage* image : {&b, &a}) {
        const auto it = image->metadata.find("whiteLuminance");
        if (it == image->metadata.end()) continue;
        const double* white = std::get_if<double>(&it->second);
        if (white && std::isfinite(*white) && *white > 0.0) return *white;
    }
    return ViewingConditions{}.display_white;
}

ThresholdDifference compare_with_threshold(const Image<Rgb>& a, const Image<Rgb>& b, const ChannelImage& aleph_map,
                                           double white) {
    const Image<float>* threshold = aleph_map.find("threshold.Y");
    if (!threshold) throw InputError("", "threshold map", "has no channel 'threshold.Y'");
    if (a.empty() || b.empty()) throw InputError("", "threshold map", "needs pictures with R, G and B");
    if (!same_size(*threshold, a)) {
        throw InputError(
            "", "threshold map",
            fmt::format("is {}x{}, the pictures are {}x{}", threshold->width, threshold->height, a.width, a.height));
    }
    ThresholdDifference result{0, white, 0.0};
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = white * std::abs(double{luminance(a.pixels[i])} - double{luminance(b.pixels[i])});
        const double limit = threshold->pixels[i];
        if (!(d <= limit) || !std::isfinite(limit)) ++result.beyond;  // NaN counts
        if (d > 0.0 && limit >= 0.0) result.worst = std::max(result.worst, d / limit);
    }
    return result;
}

}  // namespace

CompareResult compare_images(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings,
                             const ChannelImage* aleph_map) {
    const std::vector<Pair> pairs = matching_channels(a, b, settings);
    CompareResult result;
    result.width = pairs.front().b->width;
    result.height = pairs.front().b->height;
    std::vector<bool> beyond(result.pixels(), false);
    for (const Pair& pair : pairs) {
        result.channels.push_back(compare_channel(pair, settings, beyond));
        count_non_finite(*pair.a, result.a);
        count_non_finite(*pair.b, result.b);
    }
    result.beyond = static_cast<std::size_t>(std::count(beyond.begin(), beyond.end(), true));
    result.all = difference_of(pairs);
    const double white = display_white(a, b);
    const Image<Rgb> colour_a = linear_colour(a), colour_b = linear_colour(b);
    if (const auto colour = colour_pairs(pairs); !colour.empty()) {
        result.colour = difference_of(colour);
        if (all_finite(colour_a) && all_finite(colour_b)) {
            result.yee = count_visible_differences(colour_a, colour_b, {.display_white = white});
        }
    }
    if (aleph_map) result.threshold = compare_with_threshold(colour_a, colour_b, *aleph_map, white);
    const std::size_t counted = result.threshold ? result.threshold->beyond : result.beyond;
    result.same = !result.a.any() && !result.b.any() && result.percent(counted) <= settings.share;
    return result;
}

Image<Rgb> difference_picture(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings) {
    const std::vector<Pair> pairs = matching_channels(a, b, settings);
    const std::vector<Pair> colour = colour_pairs(pairs);
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
    for (const Pair& pair : pairs) {
        for (std::size_t i = 0; i < picture.size(); ++i) {
            if (!std::isfinite(pair.a->pixels[i]) || !std::isfinite(pair.b->pixels[i])) {
                picture.pixels[i] = Rgb(1.0f, 0.0f, 1.0f);
            }
        }
    }
    return picture;
}

}  // namespace aleph
