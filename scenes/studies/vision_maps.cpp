#include "scenes/studies/vision_maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "perception/perception.h"
#include "perception/threshold.h"
#include "render/frame/sequence.h"

namespace aleph {

namespace {

std::vector<double> rank(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        const double shared = 0.5 * static_cast<double>(first + end - 1);
        for (std::size_t i = first; i < end; ++i) ranks[order[i]] = shared;
        first = end;
    }
    return ranks;
}

}  // namespace

VisionMaps compute_vision_maps(const Scene& scene, const RenderSettings& settings, std::int64_t frame) {
    Sequence sequence(scene, settings);
    FrameRequest request;
    request.frame = false;
    request.maps = true;
    FrameOutput out = sequence.render(frame, request);
    const Image<float> adaptation = compute_adaptation_luminance(out.estimate, scene.viewing);
    VisionMaps maps;
    for (std::size_t i = 0; i < all_visions.size(); ++i) {
        PerceptionSettings perception = settings.perception;
        perception.vision = all_visions[i];
        maps.aleph[i] =
            compute_perception(out.estimate, out.velocity, scene.viewing, scene.frame_rate, perception).aleph;
        maps.threshold[i] = compute_threshold(maps.aleph[i], adaptation, *all_visions[i]);
    }
    maps.velocity = std::move(out.velocity);
    maps.retinal = std::move(out.perception.retinal_velocity);
    return maps;
}

std::vector<double> pick_pixels(const Image<float>& values, const Image<float>& velocity, const SpeedClass& speed) {
    std::vector<double> picked;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (velocity.pixels[i] >= speed.from && velocity.pixels[i] < speed.below) picked.push_back(values.pixels[i]);
    }
    return picked;
}

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> out(a.size());
    std::ranges::transform(a, b, out.begin(), [](double x, double y) { return x / y; });
    return out;
}

double quantile(std::vector<double> values, double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = rank(a), y = rank(b);
    const double middle = 0.5 * (static_cast<double>(x.size()) - 1.0);
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = x[i] - middle, dy = y[i] - middle;
        xy += dx * dy;
        xx += dx * dx;
        yy += dy * dy;
    }
    return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

}  // namespace aleph
