#include "render/study/visible_metrics.h"

namespace aleph {

namespace {

void add_mean(const char* metric, VariantResult& variant) {
    std::vector<double> values;
    for (const FrameResult& frame : variant.frames) values.push_back(frame.metrics.at(metric).value);
    variant.metrics[metric] = {mean_of(values).value, std::nullopt};
}

}  // namespace

std::vector<VisibleShares> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures) {
    std::vector<VisibleShares> shares;
    std::optional<VisibleDifference> difference;
    const auto take = [&](const std::vector<VisibleMaps>& finished) {
        for (const VisibleMaps& maps : finished) {
            VisibleCount count;
            count.add(maps, frames[shares.size()].maps.find("saliency.Y"));
            shares.push_back(count.shares());
        }
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || frames[i].scene != frames[i - 1].scene) {
            if (difference) take(difference->finish());
            difference.emplace(read_viewing(frames[i].maps));
        }
        const auto [picture, reference] = pictures(i);
        take(difference->add(frames[i].frame, read_pair(picture, reference), read_motion(frames[i].maps)));
    }
    if (difference) take(difference->finish());
    return shares;
}

void add_visible_metrics(const VisibleShares& shares, MetricValues& out) {
    out["share_seen"] = shares.seen;
    out["share_flicker"] = shares.flicker;
    out["share_lasting"] = shares.lasting;
    if (shares.noticed) out["share_noticed"] = *shares.noticed;
}

void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& one,
                      const std::vector<std::string>& other, VariantResult& variant) {
    const std::vector<VisibleShares> shares = measure_visible(frames, [&](std::size_t i) {
        ChannelImage picture = read_image(one.at(i));
        ChannelImage reference = expose_like(picture, read_image(other.at(i)));
        return std::pair(std::move(picture), std::move(reference));
    });
    for (std::size_t i = 0; i < shares.size(); ++i) {
        variant.frames.at(i).metrics["seed_seen"] = {shares[i].seen, std::nullopt};
        variant.frames.at(i).metrics["seed_flicker"] = {shares[i].flicker, std::nullopt};
    }
    add_mean("seed_seen", variant);
    add_mean("seed_flicker", variant);
}

}  // namespace aleph
