// The difference of two pictures as a picture.

#include <algorithm>

#include "render/compare/compare.h"
#include "render/compare/compare_channels.h"

namespace aleph {

Image<Rgb> difference_picture(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings) {
    const std::vector<ChannelPair> pairs = match_channels(a, b, settings.channels);
    const std::vector<ChannelPair> colour = colour_pairs(pairs);
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
    for (const ChannelPair& pair : pairs) {
        for (std::size_t i = 0; i < picture.size(); ++i) {
            if (!std::isfinite(pair.a->pixels[i]) || !std::isfinite(pair.b->pixels[i])) {
                picture.pixels[i] = Rgb(1.0f, 0.0f, 1.0f);
            }
        }
    }
    return picture;
}

}  // namespace aleph
