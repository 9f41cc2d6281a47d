#include "perception/visible_bands.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pyramid.h"
#include "perception/vision/fast_math.h"

namespace aleph {

namespace {

// CIE 1931 XYZ to cones of CIE 2006 for the spectrum of an LED display (Mantiuk et al. 2021, "FovVideoVDP").
constexpr double xyz_to_lms[3][3] = {{0.187596268556126, 0.585168649077728, -0.026384263306304},
                                     {-0.133397430663221, 0.405505777260049, 0.034502127690364},
                                     {0.000244379021663, -0.000542995890619, 0.019406849066323}};
// Linear Rec.709 to XYZ (IEC 61966-2-1).
constexpr double rgb_to_xyz[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
// Mechanisms of castleCSF (Ashraf et al. 2024).
constexpr double lms_to_channels[3][3] = {{1.0, 1.0, 0.0}, {1.0, -2.3112, 0.0}, {-1.0, -1.0, 50.9875}};

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const double (&a)[3][3], const Matrix& b) {
    Matrix out{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
        }
    }
    return out;
}

Matrix rgb_to_channels() {
    const Matrix xyz = product(rgb_to_xyz, Matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    return product(lms_to_channels, product(xyz_to_lms, xyz));
}

float displayed(float component) {
    const float positive = component > 0.0f ? component : 0.0f;  // also where it is NaN
    return positive < 1.0f ? positive : 1.0f;
}

/// {1 2 1} / 4 in both axes.
Image<float> soften(const Image<float>& image) {
    Image<float> rows(image.width, image.height), out(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float around = image(reflect_101(x - 1, image.width), y) + image(reflect_101(x + 1, image.width), y);
            rows(x, y) = 0.5f * image(x, y) + 0.25f * around;
        }
    }
    for (int y = 0; y < image.height; ++y) {
        const float *above = rows.row(reflect_101(y - 1, image.height)),
                    *below = rows.row(reflect_101(y + 1, image.height));
        for (int x = 0; x < image.width; ++x) out(x, y) = 0.5f * rows(x, y) + 0.25f * (above[x] + below[x]);
    }
    return out;
}

}  // namespace

Image<float> compute_visual_channel(const Image<Rgb>& picture, double white, int channel) {
    const std::array<double, 3> weights = rgb_to_channels()[static_cast<std::size_t>(channel)];
    const double reflected = channel == 0 ? screen_reflection : 0.0;
    Image<float> out(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const Rgb& p = picture.pixels[i];
        out.pixels[i] = static_cast<float>(
            white * (weights[0] * displayed(p.x) + weights[1] * displayed(p.y) + weights[2] * displayed(p.z)) +
            reflected);
    }
    return out;
}

VisualChannels compute_visual_channels(const Image<Rgb>& picture, double white) {
    VisualChannels out;
    for (int c = 0; c < visual_channels; ++c) out[c] = compute_visual_channel(picture, white, c);
    return out;
}

std::vector<BandShape> visible_bands(int width, int height) {
    // Frequencies and gains by least squares over log frequency, of gratings at castleCSF's thresholds at 100 cd/m2 and
    // 31 pixels per degree.
    std::vector<BandShape> bands{{0.4762, 1.247, 0, 0, 1}, {0.2595, 2.098, 0, 0, 4}};
    const int levels = static_cast<int>(std::floor(std::log2(std::max(4, std::min(width, height)) / 4.0)));
    for (int level = 1; level <= levels; ++level)
        bands.push_back({std::ldexp(0.2027, -level), 1.635, level - 1, level, 4});
    return bands;
}

std::vector<Image<float>> split_bands(const Image<float>& channel, std::size_t most) {
    const std::size_t count = std::min(most, visible_bands(channel.width, channel.height).size());
    std::vector<Image<float>> bands;
    const Image<float> soft = soften(channel);
    bands.push_back(difference(channel, soft));
    Image<float> coarse = reduce(channel);
    bands.push_back(difference(soft, expand(coarse, {channel.width, channel.height})));
    LevelSize finer{channel.width, channel.height};
    while (bands.size() < count) {
        const LevelSize size{coarse.width, coarse.height};
        Image<float> next = reduce(coarse);
        bands.push_back(expand(difference(coarse, expand(next, size)), finer));
        coarse = std::move(next);
        finer = size;
    }
    return bands;
}

Image<float> local_amplitude(Image<float> signal, const BandShape& band) {
    for (float& value : signal.pixels) value *= value;
    if (band.level > band.signal_level) signal = reduce(signal);
    for (int i = 0; i < band.blurs; ++i) signal = low_pass(signal);
    const auto gain = static_cast<float>(band.gain);
    for (float& value : signal.pixels) value = gain * std::sqrt(2.0f * std::max(0.0f, value));
    return signal;
}

float contrast_masking(float contrast, int channel) {
    constexpr float log2_k = -2.642585f, p = 2.264355f;  // k = 10^-.795497
    constexpr float q[visual_channels] = {1.302623f, 2.888591f, 3.680771f};
    constexpr float w[visual_channels] = {0.876909f, 1.269330f, 0.697693f};  // 2^-.189501, 2^.344067, 2^-.519338
    if (!(contrast > 0.0f)) return 1.0f;
    const float sum = 1.0f + w[channel] * fast_exp2(q[channel] * (fast_log2(contrast) + log2_k));
    return fast_exp2(fast_log2(sum) / p);
}

}  // namespace aleph
