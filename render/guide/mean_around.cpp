#include "render/guide/mean_around.h"

#include <algorithm>

#include "engine/base/parallel.h"

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

Image<float> mean_around(const Image<float>& values, bool with_own) {
    const int width = values.width, height = values.height;
    Image<Sum> rows(width, height);
    Image<float> means(width, height);
    parallel_rows(height, 8, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                for (int nx = std::max(0, x - seen_reach); nx <= std::min(width - 1, x + seen_reach); ++nx)
                    rows(x, y).add(known(values(nx, y)));
            }
        }
    });
    parallel_rows(height, 8, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                Sum sum;
                for (int ny = std::max(0, y - seen_reach); ny <= std::min(height - 1, y + seen_reach); ++ny)
                    sum.add(rows(x, ny));
                const Sum own = known(values(x, y));
                if (!with_own && sum.count > own.count) sum.add(own, -1);
                means(x, y) = sum.count > 0 ? static_cast<float>(std::max(0.0, sum.value) / sum.count) : -1.0f;
            }
        }
    });
    return means;
}

}  // namespace aleph
