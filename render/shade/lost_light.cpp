#include "render/shade/lost_light.h"

#include <algorithm>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

/// Returns whether both pixels show an object, or both show none, and their first samples saw the same.
bool shows_the_same(const PixelSamples& a, const PixelSamples& b) {
    return b.valid() > 0 && (a.coverage() > 0.0f) == (b.coverage() > 0.0f) && a.first_instance() == b.first_instance();
}

/// The pixel's share of what was lost around it: light is given in equal parts, and taken from what there is, so that
/// no pixel falls below 0.
Rgb find_weight(const PixelSamples& pixel, const Rgb& lost) {
    const Rgb mean = pixel.mean();
    Rgb weight(1.0f);
    for (int c = 0; c < 3; ++c) {
        if (lost[c] < 0.0f) weight[c] = std::max(0.0f, mean[c]);
    }
    return weight;
}

}  // namespace

void spread_lost_light(Image<PixelSamples>& pixels, int reach) {
    Image<Rgb> gained(pixels.width, pixels.height);
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            const PixelSamples& from = pixels(x, y);
            if (!from.has_kept_mean()) continue;
            const Rgb lost = from.lost();
            const auto visit = [&](const auto& give) {
                visit_around(pixels, x, y, reach, [&](int nx, int ny) {
                    if (shows_the_same(from, pixels(nx, ny))) give(nx, ny, find_weight(pixels(nx, ny), lost));
                });
            };
            Rgb sum(0.0f);
            visit([&](int, int, const Rgb& weight) { sum += weight; });
            Rgb part(0.0f);
            for (int c = 0; c < 3; ++c) part[c] = sum[c] > 0.0f ? lost[c] / sum[c] : 0.0f;
            visit([&](int nx, int ny, const Rgb& weight) { gained(nx, ny) += part * weight; });
        }
    }
    for (std::size_t i = 0; i < gained.size(); ++i) pixels.pixels[i].add_to_mean(gained.pixels[i]);
}

}  // namespace aleph
