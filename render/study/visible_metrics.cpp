#include "render/study/visible_metrics.h"

#include <algorithm>
#include <cmath>

#include "render/compare/reference_passes.h"

namespace aleph {

double find_ideal_samples(const Image<float>& seen, const Image<float>& samples) {
    std::vector<double> needed;
    needed.reserve(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
        needed.push_back(std::max(1.0, samples.pixels[i] * std::pow(static_cast<double>(seen.pixels[i]), 2.0)));
    const auto kept = needed.begin() + static_cast<std::ptrdiff_t>((99 * needed.size() + 99) / 100);
    if (kept != needed.end()) std::ranges::nth_element(needed, kept);
    needed.erase(kept, needed.end());
    return mean_of(needed).value;
}

std::vector<VisibleErrors> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures) {
    std::vector<VisibleErrors> errors;
    std::vector<Image<float>> samples;  // of frames that are not finished
    std::optional<VisibleDifference> difference;
    const auto take = [&](const std::vector<VisibleMaps>& finished) {
        for (const VisibleMaps& maps : finished) {
            VisibleCount count;
            count.add(maps, frames[errors.size()].maps.find("saliency.Y"));
            Image<float>& taken = samples[errors.size()];
            errors.push_back({count.shares()});
            if (same_size(taken, maps.seen)) errors.back().ideal_samples = find_ideal_samples(maps.seen, taken);
            taken = {};
        }
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || frames[i].scene != frames[i - 1].scene) {
            if (difference) take(difference->finish());
            difference.emplace(read_viewing(frames[i].maps));
        }
        const auto [picture, reference] = pictures(i);
        const Image<float>* const taken = picture.find("samples.Y");
        samples.push_back(taken == nullptr ? Image<float>() : *taken);
        take(difference->add(frames[i].frame, read_pair(picture, reference), read_motion(frames[i].maps)));
    }
    if (difference) take(difference->finish());
    return errors;
}

void add_visible_metrics(const VisibleErrors& errors, MetricValues& out) {
    const VisibleShares& shares = errors.shares;
    out["share_seen"] = shares.seen;
    out["share_flicker"] = shares.flicker;
    out["share_lasting"] = shares.lasting;
    if (shares.noticed) out["share_noticed"] = *shares.noticed;
    if (errors.ideal_samples) out["ideal_samples"] = *errors.ideal_samples;
}

void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& other,
                      std::vector<FrameResult>& results) {
    const std::vector<VisibleErrors> errors = measure_visible(frames, [&](std::size_t i) {
        ChannelImage picture = read_image(results.at(i).picture);
        ChannelImage reference = with_exposure_of(read_image(other.at(i)), picture);
        return std::pair(std::move(picture), std::move(reference));
    });
    for (std::size_t i = 0; i < errors.size(); ++i) {
        results.at(i).metrics["seed_seen"] = {errors[i].shares.seen, std::nullopt};
        results.at(i).metrics["seed_flicker"] = {errors[i].shares.flicker, std::nullopt};
    }
}

}  // namespace aleph
