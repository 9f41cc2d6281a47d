#include "perception/saliency/feature_maps.h"

#include "engine/base/parallel.h"
#include "perception/saliency/orientation.h"

namespace aleph {

namespace {

struct LevelPair {
    int center, surround;
};
constexpr std::array<LevelPair, 6> level_pairs = {{{2, 5}, {2, 6}, {3, 6}, {3, 7}, {4, 7}, {4, 8}}};

/// A pyramid from which feature maps are made.
struct Source {
    FeatureChannel channel;
    const std::vector<Image<float>>* levels;
};

FeatureMap make_feature_map(const Source& source, LevelPair pair, const std::vector<LevelSize>& sizes) {
    const Image<float>& center = (*source.levels)[pair.center];
    Image<float> difference = expand_to_level((*source.levels)[pair.surround], sizes, pair.surround, pair.center);
    for (std::size_t i = 0; i < difference.size(); ++i) {
        difference.pixels[i] = center.pixels[i] - difference.pixels[i];
    }
    return {source.channel, pair.center, std::move(difference)};
}

}  // namespace

std::vector<FeatureMap> make_feature_maps(const ChannelPyramids& pyramids) {
    const std::vector<LevelSize> sizes = pyramid_sizes(pyramids.size.width, pyramids.size.height, saliency_levels);

    std::array<std::vector<Image<float>>, orientation_count> oriented;
    for (auto& levels : oriented) levels.resize(saliency_levels);
    parallel_for(saliency_levels - finest_center, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t level = i + finest_center;
            auto responses = compute_orientations(pyramids.a[level]);
            for (std::size_t o = 0; o < oriented.size(); ++o) oriented[o][level] = std::move(responses[o]);
        }
    });

    std::vector<Source> sources = {{FeatureChannel::intensity, &pyramids.a},
                                   {FeatureChannel::color, &pyramids.c1},
                                   {FeatureChannel::color, &pyramids.c2}};
    for (const auto& levels : oriented) sources.push_back({FeatureChannel::orientation, &levels});
    sources.push_back({FeatureChannel::motion, &pyramids.velocity});

    std::vector<FeatureMap> maps(sources.size() * level_pairs.size());
    parallel_for(maps.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            maps[i] = make_feature_map(sources[i / level_pairs.size()], level_pairs[i % level_pairs.size()], sizes);
        }
    });
    return maps;
}

}  // namespace aleph
