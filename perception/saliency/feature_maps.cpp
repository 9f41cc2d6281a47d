#include "perception/saliency/feature_maps.h"

#include <cmath>
#include <numbers>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

/// cos and sin of frequency * position along one axis; the wave of a pixel is the product of its axes'.
struct AxisWave {
    std::vector<float> cosine, sine;

    AxisWave(int size, double frequency) {
        for (int i = 0; i < size; ++i) {
            cosine.push_back(static_cast<float>(std::cos(frequency * i)));
            sine.push_back(static_cast<float>(std::sin(frequency * i)));
        }
    }
};

Image<float> compute_orientation(const Image<float>& high_pass, double degrees) {
    const double radians = degrees * std::numbers::pi / 180.0;
    const double frequency = std::numbers::pi / 2;  // per pixel of this level
    const AxisWave wave_x(high_pass.width, frequency * std::cos(radians));
    const AxisWave wave_y(high_pass.height, frequency * std::sin(radians));
    Image<float> real(high_pass.width, high_pass.height);
    Image<float> imaginary(high_pass.width, high_pass.height);
    for (int y = 0; y < high_pass.height; ++y) {
        const float cos_y = wave_y.cosine[y];
        const float sin_y = wave_y.sine[y];
        const float* const h = high_pass.row(y);
        float* const re = real.row(y);
        float* const im = imaginary.row(y);
        const float* const cos_x = wave_x.cosine.data();
        const float* const sin_x = wave_x.sine.data();
        for (int x = 0; x < high_pass.width; ++x) {
            re[x] = h[x] * (cos_x[x] * cos_y - sin_x[x] * sin_y);
            im[x] = h[x] * (sin_x[x] * cos_y + cos_x[x] * sin_y);
        }
    }
    real = low_pass(real);
    imaginary = low_pass(imaginary);
    for (std::size_t i = 0; i < real.size(); ++i) {
        const float re = real.pixels[i], im = imaginary.pixels[i];
        real.pixels[i] = std::sqrt(re * re + im * im);
    }
    return real;
}

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
    Image<float> surround = expand_to_level((*source.levels)[pair.surround], sizes, pair.surround, pair.center);
    return {source.channel, pair.center, difference(center, std::move(surround))};
}

}  // namespace

std::array<Image<float>, orientation_count> compute_orientations(const Image<float>& level) {
    const Image<float> high_pass = difference(level, low_pass(level));
    std::array<Image<float>, orientation_count> out;
    for (std::size_t o = 0; o < out.size(); ++o) out[o] = compute_orientation(high_pass, orientation_degrees[o]);
    return out;
}

std::vector<FeatureMap> make_feature_maps(const ChannelPyramids& pyramids) {
    const std::vector<LevelSize> sizes = pyramid_sizes(pyramids.size.width, pyramids.size.height, saliency_levels);

    std::array<std::vector<Image<float>>, orientation_count> oriented;
    for (auto& levels : oriented) levels.resize(saliency_levels);
    parallel_each(saliency_levels - finest_center, 1, [&](std::size_t i) {
        const std::size_t level = i + finest_center;
        auto responses = compute_orientations(pyramids.a[level]);
        for (std::size_t o = 0; o < oriented.size(); ++o) oriented[o][level] = std::move(responses[o]);
    });

    std::vector<Source> sources = {{FeatureChannel::intensity, &pyramids.a},
                                   {FeatureChannel::color, &pyramids.c1},
                                   {FeatureChannel::color, &pyramids.c2}};
    for (const auto& levels : oriented) sources.push_back({FeatureChannel::orientation, &levels});
    sources.push_back({FeatureChannel::motion, &pyramids.velocity});

    std::vector<FeatureMap> maps(sources.size() * level_pairs.size());
    parallel_each(maps.size(), 1, [&](std::size_t i) {
        maps[i] = make_feature_map(sources[i / level_pairs.size()], level_pairs[i % level_pairs.size()], sizes);
    });
    return maps;
}

}  // namespace aleph
