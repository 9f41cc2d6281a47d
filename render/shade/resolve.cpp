#include "render/shade/resolve.h"

#include <algorithm>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

/// Pixels among which lost light is shared.
class Sharing {
  public:
    Sharing(const Image<PixelSamples>& pixels, const Image<Outline>& outlines) : pixels_(pixels), outlines_(outlines) {}

    /// Returns whether both pixels show an object, or both show none, and either both have an outline or neither, and
    /// their first samples saw the same.
    bool has(int x, int y, int other_x, int other_y) const {
        const PixelSamples &a = pixels_(x, y), &b = pixels_(other_x, other_y);
        if (b.valid() == 0 || (a.coverage() > 0.0f) != (b.coverage() > 0.0f)) return false;
        if (!are_alike(outlines_, x, y, other_x, other_y)) return false;
        const bool shows_several = !outlines_.empty() && outlines_(x, y) != Outline::none;
        return shows_several || a.first_instance() == b.first_instance();
    }

  private:
    const Image<PixelSamples>& pixels_;
    const Image<Outline>& outlines_;
};

/// Light that a pixel has lost, without what lies beyond white.
Rgb find_lost(const PixelSamples& pixel, double white) {
    const Rgb mean = pixel.mean();
    Rgb lost = pixel.lost();
    for (int c = 0; c < 3; ++c) {
        if (mean[c] > white) lost[c] = 0.0f;
    }
    return lost;
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

void spread_lost_light(Image<PixelSamples>& pixels, const Image<Outline>& outlines, int reach, double white) {
    const Sharing sharing(pixels, outlines);
    Image<Rgb> gained(pixels.width, pixels.height);
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            const PixelSamples& from = pixels(x, y);
            if (!from.has_kept_mean()) continue;
            const Rgb lost = find_lost(from, white);
            const auto visit = [&](const auto& give) {
                visit_around(pixels, x, y, reach, [&](int nx, int ny) {
                    if (sharing.has(x, y, nx, ny)) give(nx, ny, find_weight(pixels(nx, ny), lost));
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

void resolve_pixels(const Image<PixelSamples>& pixels, double exposure, bool with_indirect, bool with_variance,
                    ShadedFrame& out) {
    const float scale = static_cast<float>(exposure);
    const int width = pixels.width, height = pixels.height;
    out.color = Image<Rgb>(width, height);
    out.coverage = out.samples = Image<float>(width, height);
    if (with_indirect) out.indirect = Image<Rgb>(width, height);
    if (with_variance) out.variance = Image<float>(width, height);
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        const PixelSamples& pixel = pixels.pixels[p];
        out.color.pixels[p] = pixel.mean() * scale;
        out.coverage.pixels[p] = pixel.coverage();
        out.samples.pixels[p] = static_cast<float>(pixel.taken());
        out.counts.samples += static_cast<std::uint64_t>(pixel.taken());
        if (with_indirect) out.indirect.pixels[p] = pixel.mean_indirect() * scale;
        if (with_variance) out.variance.pixels[p] = static_cast<float>(pixel.variance() * exposure * exposure);
    }
}

void count_samples(const Image<PixelSamples>& pixels, ShadedFrame& out) {
    for (const PixelSamples& pixel : pixels.pixels) out.counts.samples += static_cast<std::uint64_t>(pixel.taken());
}

void resolve_uses(const Image<RecordUse>& uses, const Image<PixelSamples>& pixels, ShadedFrame& out) {
    out.cache_count = out.cache_radius = Image<float>(uses.width, uses.height);
    for (std::size_t p = 0; p < uses.size(); ++p) {
        const RecordUse& used = uses.pixels[p];
        if (!(used.weights > 0.0f)) continue;
        out.cache_count.pixels[p] = used.count / static_cast<float>(pixels.pixels[p].taken());
        out.cache_radius.pixels[p] = used.reaches / used.weights;
    }
}

}  // namespace aleph
