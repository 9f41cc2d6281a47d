#include "render/settings/frame_list.h"

#include <fmt/format.h>

#include <charconv>
#include <unordered_set>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr std::int64_t max_frames = 10'000'000;

[[noreturn]] void refuse(std::string_view item, const std::string& reason) {
    throw InputError("", "--frames", fmt::format("'{}': {}", printable(item), reason));
}

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Removes a number from the start of `rest`.
int take_number(std::string_view item, std::string_view& rest) {
    int value = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc::result_out_of_range) refuse(item, "this number is too large for a frame");
    if (error != std::errc{}) refuse(item, "expected N, A-B or A-BxS, as in 1-10,20-40x2");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
}

bool take(char c, std::string_view& rest) {
    if (rest.empty() || rest.front() != c) return false;
    rest.remove_prefix(1);
    return true;
}

struct Range {
    std::int64_t first, last, step;
    std::int64_t count() const { return (last - first) / step + 1; }
};

Range parse_item(std::string_view item) {
    std::string_view rest = item;
    const int first = take_number(item, rest);
    Range range{first, first, 1};
    if (take('-', rest)) {
        range.last = take_number(item, rest);
        if (take('x', rest)) range.step = take_number(item, rest);
    }
    if (!rest.empty()) refuse(item, "expected N, A-B or A-BxS, as in 1-10,20-40x2");
    if (range.last < range.first) refuse(item, "the last frame lies before the first");
    if (range.step < 1) refuse(item, "the step must be at least 1");
    return range;
}

}  // namespace

std::vector<int> parse_frame_list(std::string_view text) {
    if (text.find(':') != std::string_view::npos) {
        refuse(text,
               "':' means a step to Slurm and a stagger to Fileseq; write a step as 1-20x2, and a stagger as the "
               "frames in their order");
    }
    std::vector<int> frames;
    std::unordered_set<int> seen;
    std::int64_t named = 0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::string_view item = trim(text.substr(begin, comma - begin));
        if (item.empty()) refuse(text, "a frame is missing");
        const Range range = parse_item(item);
        named += range.count();
        if (named > max_frames) refuse(text, fmt::format("more than {} frames", max_frames));
        for (std::int64_t frame = range.first; frame <= range.last; frame += range.step) {
            if (seen.insert(static_cast<int>(frame)).second) frames.push_back(static_cast<int>(frame));
        }
        begin = comma + 1;
    }
    return frames;
}

std::string format_frame_list(const std::vector<int>& frames) {
    const auto distance = [&](std::size_t i) { return std::int64_t{frames[i + 1]} - frames[i]; };
    std::string text;
    for (std::size_t first = 0, last = 0; first < frames.size(); first = ++last) {
        const std::int64_t step = first + 1 < frames.size() ? distance(first) : 0;
        while (step > 0 && last + 1 < frames.size() && distance(last) == step) ++last;
        if (step > 1 && last == first + 1) last = first;  // two frames are no row
        if (!text.empty()) text += ',';
        text += fmt::format("{}", frames[first]);
        if (last > first) text += fmt::format("-{}", frames[last]);
        if (last > first && step > 1) text += fmt::format("x{}", step);
    }
    return text;
}

std::optional<std::string> describe_frame_outside(std::int64_t frame, const FrameRange& range) {
    if (frame >= range.first && frame <= range.last) return std::nullopt;
    return fmt::format("frame {} lies outside the shot, which has the frames {} to {}", frame, range.first, range.last);
}

}  // namespace aleph
