#include "render/verify/probe.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace aleph {

namespace {

constexpr int least_samples = 64;
constexpr int most_in_window = 12288;  // samples of a pixel, in all frames

/// How many to add so that the noise settles: its mean square falls as their number does.
int choose_samples(int samples, double noise, int most_samples) {
    if (samples == 0) return least_samples;
    const double needed = std::max(1.1 * noise / settled_noise, 1.25) * samples;
    return static_cast<int>(std::min({needed, 4.0 * samples, 1.0 * most_samples})) - samples;
}

using Pairs = std::vector<PicturePair>;

VisibleMaps judge(const ProbeWindow& window, const Pairs& pairs, std::int64_t frame, const ViewingSettings& viewing) {
    VisibleDifference difference(viewing, frame);
    std::vector<VisibleMaps> maps;
    for (std::size_t i = 0; i < pairs.size() && maps.empty(); ++i)
        maps = difference.add(window.frames[i].frame, pairs[i], window.frames[i].motion);
    if (maps.empty()) maps = difference.finish();
    return std::move(maps.front());
}

/// The references, and what they would be with other noise of the same strength.
Pairs noise_alone(Pairs pairs) {
    for (PicturePair& pair : pairs) {
        pair.picture = pair.reference;
        for (std::size_t i = 0; i < pair.noise.size(); ++i) pair.picture.pixels[i] += pair.noise.pixels[i];
        pair.noise = {};
    }
    return pairs;
}

double mean_square(const Image<float>& image) {
    double sum = 0.0;
    for (const float value : image.pixels) sum += double{value} * value;
    return sum / static_cast<double>(image.size());
}

double count(const Image<float>& image, double least) {
    return static_cast<double>(std::ranges::count_if(image.pixels, [&](float value) { return value >= least; }));
}

/// Upper end of the interval, from the blocks and one more: it stands for those of a kind that none of them is.
double upper_end(std::span<const BlockCount> blocks) {
    double pixels = 0.0, counted = 0.0, largest = 0.0;
    for (const BlockCount& block : blocks) {
        pixels += block.pixels;
        counted += block.counted;
        if (block.pixels > 0.0) largest = std::max(largest, block.counted / block.pixels);
    }
    const auto n = static_cast<double>(blocks.size());
    const BlockCount unseen{pixels / n, pixels / n * (largest > 0.0 ? std::sqrt(largest) : 1.0)};
    const double share = (counted + unseen.counted) / (pixels + unseen.pixels);
    double squares = std::pow(unseen.counted - share * unseen.pixels, 2.0);
    for (const BlockCount& block : blocks) squares += std::pow(block.counted - share * block.pixels, 2.0);
    const double deviation = std::sqrt(squares / n / (n + 1.0)) / unseen.pixels;
    return std::min(1.0, share + student_95(blocks.size()) * deviation);
}

}  // namespace

Prober::Prober(Scene scene, const RenderSettings& settings, const std::string& camera, std::vector<std::int64_t> frames,
               PictureKeeper& pictures)
    : reference_(std::move(scene), traced_reference_settings(settings), camera),
      width_(settings.picture.width),
      height_(settings.picture.height),
      error_(settings.error > 0.0 ? settings.error : 1.0),
      frames_(std::move(frames)),
      pictures_(pictures) {}

ProbeResult Prober::measure(std::size_t number, const FrameProgress& progress) {
    ProbeResult result{.place = place_probe(number, frames_, width_, height_)};
    ProbeWindow window = find_probe_window(result.place, reference_);
    const Scene& scene = reference_.scene();
    const ViewingSettings viewing{scene.film.viewing, scene.film.frame_rate};
    const int most_samples = most_in_window / static_cast<int>(window.frames.size());
    Pairs pairs;
    for (int round = 0;; ++round) {
        const int more = choose_samples(result.samples, result.noise, most_samples) / 2;
        add_reference_samples(window, round, more, reference_, progress);
        result.samples += 2 * more;
        pairs.clear();
        for (const ProbeFrame& each : window.frames)
            pairs.push_back(make_probe_pair(each, window.area, pictures_.find(each.frame)));
        const VisibleMaps noise = judge(window, noise_alone(pairs), result.place.frame, viewing);
        result.noise = mean_square(crop(noise.seen, window.block));
        if (result.noise <= settled_noise || result.samples >= most_samples - least_samples) break;
    }
    const VisibleMaps maps = judge(window, pairs, result.place.frame, viewing);
    const Image<float> seen = crop(maps.seen, window.block);
    result.window = window.frames.size();
    result.pixels = static_cast<double>(seen.size());
    result.beyond = count(seen, error_);
    result.seen = count(seen, 1.0);
    result.flicker = count(crop(maps.flicker, window.block), 1.0);
    result.lasting = count(crop(maps.lasting, window.block), 1.0);
    return result;
}

double student_95(std::size_t freedom) {
    constexpr double few[] = {12.7062, 4.3027, 3.1824, 2.7764};
    if (freedom <= std::size(few)) return few[std::max<std::size_t>(freedom, 1) - 1];
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const auto n = static_cast<double>(freedom);  // Cornish and Fisher's expansion
    return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n) +
           (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n);
}

VerifiedShare estimate_share(std::span<const BlockCount> blocks) {
    double pixels = 0.0, counted = 0.0;
    std::vector<BlockCount> others;
    for (const BlockCount& block : blocks) {
        pixels += block.pixels;
        counted += block.counted;
        others.push_back({block.pixels, block.pixels - block.counted});
    }
    if (!(pixels > 0.0)) return {};
    return {counted / pixels, 1.0 - upper_end(others), upper_end(blocks)};
}

VerifiedStatistics sum_up(std::span<const ProbeResult> probes, double error) {
    VerifiedStatistics out;
    out.error = error;
    const auto share = [&](double ProbeResult::*counted) {
        std::vector<BlockCount> blocks;
        for (const ProbeResult& probe : probes) blocks.push_back({probe.pixels, probe.*counted});
        return estimate_share(blocks);
    };
    out.beyond = share(&ProbeResult::beyond);
    out.seen = share(&ProbeResult::seen);
    out.flicker = share(&ProbeResult::flicker);
    out.lasting = share(&ProbeResult::lasting);
    out.blocks = probes.size();
    std::set<std::int64_t> frames;
    for (const ProbeResult& probe : probes) {
        frames.insert(probe.place.frame);
        out.window = std::max(out.window, probe.window);
        if (probe.noise > settled_noise) ++out.unsettled;
    }
    out.frames = frames.size();
    return out;
}

void PictureKeeper::keep(std::int64_t frame, Image<Rgb> picture) {
    if (std::ranges::find(pictures_, frame, &decltype(pictures_)::value_type::first) != pictures_.end()) return;
    bytes_ += picture.size() * sizeof(Rgb);
    pictures_.emplace_front(frame, std::move(picture));
    while (bytes_ > most_ && pictures_.size() > 1) {
        bytes_ -= pictures_.back().second.size() * sizeof(Rgb);
        pictures_.pop_back();
    }
}

const Image<Rgb>& PictureKeeper::find(std::int64_t frame) {
    const auto found = std::ranges::find(pictures_, frame, &decltype(pictures_)::value_type::first);
    if (found != pictures_.end()) {
        pictures_.splice(pictures_.begin(), pictures_, found);
    } else {
        keep(frame, make_(frame));
    }
    return pictures_.front().second;
}

}  // namespace aleph
