#include "render/compare/visible_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/base/errors.h"
#include "engine/base/pixel_loops.h"
#include "engine/base/pyramid.h"
#include "render/compare/compare_luminance.h"
#include "render/compare/visible_signal.h"

namespace aleph {

namespace {

std::vector<std::size_t> find_broken(const Image<Rgb>& a, const Image<Rgb>& b) {
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!is_finite(a.pixels[i]) || !is_finite(b.pixels[i])) broken.push_back(i);
    }
    return broken;
}

/// The eye is adapted to the mean over about half a degree, and for coarser bands over the band's own pixels: Gaussian
/// levels of the reference, each at the size of its band's level.
std::vector<Image<float>> find_background(const Image<float>& achromatic, int levels, double pixels_per_degree) {
    const int adaptation =
        static_cast<int>(std::clamp(std::round(std::log2(0.5 * pixels_per_degree)), 1.0, levels + 1.0));
    const std::vector<LevelSize> sizes = pyramid_sizes(achromatic.width, achromatic.height, levels + 2);
    const std::vector<Image<float>> gaussian = make_gaussian_pyramid(achromatic, levels + 2);
    std::vector<Image<float>> background;
    for (int level = 0; level <= levels; ++level) {
        const int from = std::max(adaptation, level + 1);
        background.push_back(expand_to_level(gaussian[from], sizes, from, level));
    }
    return background;
}

/// Every second pixel, for the coarser level, of an image that changes slowly.
Image<float> even_pixels(const Image<float>& image) {
    Image<float> half((image.width + 1) / 2, (image.height + 1) / 2);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) half(x, y) = image(2 * x, 2 * y);
    }
    return half;
}

Image<float> least(const Image<float>& a, const Image<float>& b) {
    return map_pixels([](float one, float other) { return std::min(one, other); }, a, b);
}

std::vector<Image<float>> differences(const std::vector<Image<float>>& a, std::vector<Image<float>> b) {
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = difference(a[i], std::move(b[i]));
    return b;
}

}  // namespace

std::optional<FrameRate> find_frame_rate(const ChannelImage& image) {
    const auto found = image.metadata.find("framesPerSecond");
    const auto* const rate = found == image.metadata.end() ? nullptr : std::get_if<std::array<int, 2>>(&found->second);
    if (rate == nullptr || (*rate)[0] <= 0 || (*rate)[1] <= 0) return std::nullopt;
    return FrameRate{(*rate)[0], (*rate)[1]};
}

ViewingSettings read_viewing(const ChannelImage& maps) {
    ViewingSettings settings;
    const auto take = [&](const char* key, double& value) { value = find_number(maps, key).value_or(value); };
    take("whiteLuminance", settings.viewing.display_white);
    take("pixelsPerDegree", settings.viewing.pixels_per_degree);
    take("displayPersistence", settings.viewing.persistence);
    settings.frame_rate = find_frame_rate(maps).value_or(settings.frame_rate);
    return settings;
}

Image<Rgb> read_noise(const ChannelImage& reference) {
    const double passes = find_number(reference, "passes").value_or(1.0);
    if (passes < 2.0) return {};
    Image<Rgb> noise = join_channels(reference, "noise.");
    if (noise.empty() || std::fmod(passes, 2.0) == 0.0) return noise;
    // One sign more than of the other kind: the mean takes what is common off. Of n renderings this leaves n - 1/n of
    // the n squares.
    const Image<Rgb> mean = linear_colour(reference);
    const auto full = static_cast<float>(1.0 / std::sqrt(1.0 - 1.0 / (passes * passes)));
    const auto share = static_cast<float>(1.0 / passes);
    for (std::size_t i = 0; i < noise.size(); ++i) noise.pixels[i] = full * (noise.pixels[i] - share * mean.pixels[i]);
    return noise;
}

void VisibleDifference::prepare(int width, int height) {
    shapes_ = visible_bands(width, height);
    for (int channel = 0; channel < visual_channels; ++channel) {
        for (const BandShape& shape : shapes_) {
            filters_.emplace_back(channel, shape.frequency * settings_.viewing.pixels_per_degree, settings_.viewing,
                                  settings_.frame_rate, settings_.tracking);
        }
    }
}

std::vector<VisibleMaps> VisibleDifference::add(std::int64_t frame, const PicturePair& pictures, MotionMaps maps,
                                                bool cut) {
    const auto& [picture, reference, noise] = pictures;
    if (!same_size(picture, reference) || !same_size(picture, maps.u) || picture.empty()) {
        throw InputError("", "",
                         fmt::format("the pictures are {}x{} and {}x{}, the maps {}x{}", picture.width, picture.height,
                                     reference.width, reference.height, maps.u.width, maps.u.height));
    }
    std::vector<VisibleMaps> finished;
    if (!frames_.empty() && (cut || frames_.back().number + 1 != frame)) finished = finish();
    if (shapes_.empty()) prepare(picture.width, picture.height);
    if (!frames_.empty() && !same_size(frames_.back().motion.u, maps.u))
        throw InputError("", "", fmt::format("frame {} has another size than the frame before", frame));
    const double white = settings_.viewing.display_white;
    const VisualChannels shown = compute_visual_channels(picture, white),
                         truth = compute_visual_channels(reference, white);
    VisualChannels noisy;
    if (!noise.empty()) noisy = compute_visual_channels(map_pixels(std::plus<Rgb>(), reference, noise), white);
    Frame next{frame,
               std::move(maps),
               {},
               {},
               {},
               find_background(truth[0], shapes_.back().level, settings_.viewing.pixels_per_degree),
               find_broken(picture, reference)};
    parallel_for(visual_channels, 1, [&](std::size_t c, std::size_t) {
        Bands a = split_bands(shown[c]), b = split_bands(truth[c]);
        for (std::size_t i = 0; i < a.size(); ++i)
            next.masker[c].push_back(least(local_amplitude(a[i], shapes_[i]), local_amplitude(b[i], shapes_[i])));
        if (!noise.empty()) next.noise[c] = differences(split_bands(noisy[c]), b);
        next.error[c] = differences(a, std::move(b));
    });
    frames_.push_back(std::move(next));
    const auto reach = static_cast<std::size_t>(filter_reach(settings_.frame_rate));
    while (done_ + reach < frames_.size()) {
        measure_next(finished);
        if (done_ > reach) {
            frames_.pop_front();
            --done_;
        }
    }
    return finished;
}

std::vector<VisibleMaps> VisibleDifference::finish() {
    std::vector<VisibleMaps> finished;
    while (done_ < frames_.size()) measure_next(finished);
    frames_.clear();
    done_ = 0;
    shapes_.clear();
    filters_.clear();
    return finished;
}

void VisibleDifference::measure_next(std::vector<VisibleMaps>& finished) {
    if (!only_ || frames_[done_].number == *only_) finished.push_back(measure(done_));
    ++done_;
}

VisibleMaps VisibleDifference::measure(std::size_t index) const {
    const Frame& frame = frames_[index];
    const auto reach = static_cast<std::size_t>(filter_reach(settings_.frame_rate));
    const std::size_t first = index - std::min(index, reach), end = std::min(index + reach + 1, frames_.size());
    std::vector<const MotionMaps*> motion;
    for (std::size_t i = first; i < end; ++i) motion.push_back(&frames_[i].motion);
    const SurfaceTracks tracks = track_surfaces(motion, index - first);
    const Image<float> velocity = image_velocity(frame.motion, tracks, settings_);

    const int width = frame.motion.u.width, height = frame.motion.u.height;
    const std::vector<LevelSize> sizes = pyramid_sizes(width, height, shapes_.back().level + 1);
    const Image<float> none(width, height);
    VisibleMaps maps{frame.number, none, none, none};
    const bool has_noise = std::ranges::none_of(frames_, [](const Frame& each) { return each.noise[0].empty(); });
    for (std::size_t b = 0; b < shapes_.size(); ++b) {
        for (std::size_t c = 0; c < visual_channels; ++c) {
            const BandShape& shape = shapes_[b];
            const auto filter = [&](const std::array<Bands, visual_channels> Frame::*signals) {
                BandWindow window{{}, {}, {}, tracks, shape.signal_level, static_cast<int>(reach)};
                const auto signal = [&](std::size_t i) {
                    return BandFrame{&(frames_[i].*signals)[c][b], &frames_[i].background[shape.signal_level]};
                };
                window.current = signal(index);
                for (std::size_t i = index + 1; i < end; ++i) window.next.push_back(signal(i));
                for (std::size_t i = index; i-- > first;) window.previous.push_back(signal(i));
                return filter_band(window, filters_[c * shapes_.size() + b], velocity);
            };
            const SignalParts parts = filter(&Frame::error);
            const Image<float> elevation =
                masking_elevation(frame.masker[c][b], frame.background[shape.level],
                                  shape.level > shape.signal_level ? even_pixels(parts.sensitivity) : parts.sensitivity,
                                  static_cast<int>(c));
            add_squares(parts, elevation, shape, sizes, 1.0f, maps);
            if (has_noise) add_squares(filter(&Frame::noise), elevation, shape, sizes, -1.0f, maps);
        }
    }
    for (Image<float>* sum : {&maps.seen, &maps.flicker, &maps.lasting}) {
        for (float& value : sum->pixels) value = std::sqrt(std::max(0.0f, value));
    }
    for (const std::size_t i : frame.broken)
        maps.seen.pixels[i] = maps.lasting.pixels[i] = std::numeric_limits<float>::infinity();
    return maps;
}

}  // namespace aleph
