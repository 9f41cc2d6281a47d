#include "render/verify/continued_error.h"

#include <algorithm>
#include <array>

#include "engine/base/pyramid.h"

namespace aleph {

namespace {

/// Values times weights, and weights.
struct Weighted {
    std::array<Image<float>, 3> sums;
    Image<float> weights;
};

Weighted pull(const Weighted& fine) {
    return {{reduce(fine.sums[0]), reduce(fine.sums[1]), reduce(fine.sums[2])}, reduce(fine.weights)};
}

/// Fills what weighs less than 1 from the coarser level.
void push(const Weighted& coarse, Weighted& fine) {
    const LevelSize size{fine.weights.width, fine.weights.height};
    for (Image<float>& sums : fine.sums) {
        const Image<float> beyond = expand(coarse.sums[static_cast<std::size_t>(&sums - fine.sums.data())], size);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums.pixels[i] += (1.0f - fine.weights.pixels[i]) * beyond.pixels[i];
    }
}

/// Weights of at most 1: what is known well keeps its value.
void saturate(Weighted& level) {
    for (std::size_t i = 0; i < level.weights.size(); ++i) {
        float& weight = level.weights.pixels[i];
        const float full = std::min(1.0f, 4.0f * weight);
        const float scale = weight > 0.0f ? full / weight : 0.0f;
        for (Image<float>& sums : level.sums) sums.pixels[i] *= scale;
        weight = full;
    }
}

}  // namespace

Image<Rgb> continue_error(const Image<Rgb>& error, const PicturePart& part) {
    const Image<float> empty(error.width, error.height);
    std::vector<Weighted> levels{{{empty, empty, empty}, empty}};
    bool any = false;
    for (std::size_t i = 0; i < error.size(); ++i) {
        if (part.pixels[i] == 0 || !is_finite(error.pixels[i])) continue;
        any = true;
        levels[0].weights.pixels[i] = 1.0f;
        for (int c = 0; c < 3; ++c) levels[0].sums[static_cast<std::size_t>(c)].pixels[i] = error.pixels[i][c];
    }
    Image<Rgb> out(error.width, error.height, Rgb(0.0f));
    if (!any) return out;
    while (levels.back().weights.width > 1 || levels.back().weights.height > 1) {
        levels.push_back(pull(levels.back()));
        saturate(levels.back());
    }
    Weighted& top = levels.back();  // one pixel, which may weigh little
    for (Image<float>& sums : top.sums) sums.pixels[0] /= std::max(top.weights.pixels[0], 1e-6f);
    for (std::size_t i = levels.size() - 1; i-- > 0;) push(levels[i + 1], levels[i]);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out.pixels[i] = {levels[0].sums[0].pixels[i], levels[0].sums[1].pixels[i], levels[0].sums[2].pixels[i]};
        if (part.pixels[i] != 0 && !is_finite(error.pixels[i])) out.pixels[i] = error.pixels[i];
    }
    return out;
}

}  // namespace aleph
