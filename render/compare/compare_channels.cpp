#include "render/compare/compare_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/base/errors.h"

namespace aleph {

namespace {

/// How certain a picture is.
bool is_certainty(const std::string& channel) {
    return channel == "variance.Y" || channel.starts_with("error.");
}

constexpr std::array<std::string_view, 5> count_names = {"samples.Y", "records.Y", "invalid.Y", "cache.count",
                                                         "cache.radius"};

bool belongs_to(const std::string& channel, const std::string& wanted) {
    return channel == wanted || channel.starts_with(wanted + ".");
}

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

std::vector<ChannelPair> match_all(const ChannelImage& a, const ChannelImage& b) {
    const auto only_a = missing_in(b, a), only_b = missing_in(a, b);
    if (!only_a.empty() || !only_b.empty()) {
        throw InputError("", "",
                         fmt::format("the pictures differ in channels: only the first has [{}], only the second [{}]",
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

}  // namespace

std::vector<ChannelPair> match_channels(const ChannelImage& a, const ChannelImage& b,
                                        const std::vector<std::string>& wanted) {
    check_sizes(a, b);
    if (wanted.empty()) return match_all(a, b);
    std::vector<ChannelPair> pairs;
    for (const std::string& name : wanted) {
        bool found = false;
        for (const Channel& channel : b.channels) {
            const Image<float>* in_a = a.find(channel.name);
            if (!belongs_to(channel.name, name) || !in_a) continue;
            found = true;
            if (std::ranges::find(pairs, channel.name, &ChannelPair::name) == pairs.end()) {
                pairs.push_back({channel.name, in_a, &channel.values});
            }
        }
        if (!found) throw InputError("", fmt::format("channel '{}'", printable(name)), "is not in both pictures");
    }
    return pairs;
}

std::vector<ChannelPair> colour_pairs(const std::vector<ChannelPair>& pairs) {
    std::vector<ChannelPair> colour;
    for (const char* name : {"R", "G", "B"}) {
        const auto found = std::ranges::find(pairs, name, &ChannelPair::name);
        if (found != pairs.end()) colour.push_back(*found);
    }
    return colour.size() == 3 ? colour : std::vector<ChannelPair>{};
}

}  // namespace aleph
