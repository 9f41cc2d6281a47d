#include "render/guide/mean_around.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

struct Sum {
    double value = 0.0;
    int count = 0;

    void add(const Sum& other, int sign = 1) {
        value += sign * other.value;
        count += sign * other.count;
    }
};

Sum known(float value) {
    return value >= 0.0f ? Sum{static_cast<double>(value), 1} : Sum{};
}

}  // namespace

int find_seen_reach(double pixels_per_degree) {
    constexpr double degrees = 4.0 / 31.0;
    return static_cast<int>(std::clamp(std::round(degrees * pixels_per_degree), 1.0, 1000.0));
}

Image<float> mean_around(const Image<float>& values, int reach, bool with_own) {
    const int width = values.width, height = values.height;
    Image<Sum> rows(width, height);
    Image<float> means(width, height);
    parallel_pixels(values, 8, [&](int x, int y) {
        for (int nx = std::max(0, x - reach); nx <= std::min(width - 1, x + reach); ++nx)
            rows(x, y).add(known(values(nx, y)));
    });
    parallel_pixels(values, 8, [&](int x, int y) {
        Sum sum;
        for (int ny = std::max(0, y - reach); ny <= std::min(height - 1, y + reach); ++ny) sum.add(rows(x, ny));
        const Sum own = known(values(x, y));
        if (!with_own && sum.count > own.count) sum.add(own, -1);
        means(x, y) = sum.count > 0 ? static_cast<float>(std::max(0.0, sum.value) / sum.count) : -1.0f;
    });
    return means;
}

}  // namespace aleph
