#include "render/shade/resolve.h"

namespace aleph {

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
