#include "engine/base/pyramid.h"

#include <algorithm>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr float kernel_center = 0.4f;
constexpr float kernel_near = 0.25f;
constexpr float kernel_far = 0.05f;
constexpr int padding = 2;  // the kernel's reach

int half_size(int n) {
    return (n + 1) / 2;
}

/// The kernel down the columns at row y, into `out` (padded on both sides for the pass along the row).
void filter_columns(const Image<float>& image, int y, float* out) {
    const int w = image.width;
    const float* const center = image.row(y);
    if (image.height == 1) {
        std::copy_n(center, w, out);
    } else {
        const float* const up = image.row(reflect_101(y - 1, image.height));
        const float* const up2 = image.row(reflect_101(y - 2, image.height));
        const float* const down = image.row(reflect_101(y + 1, image.height));
        const float* const down2 = image.row(reflect_101(y + 2, image.height));
        for (int x = 0; x < w; ++x) {
            out[x] = kernel_far * (up2[x] + down2[x]) + kernel_near * (up[x] + down[x]) + kernel_center * center[x];
        }
    }
    for (int i = 1; i <= padding; ++i) {
        out[-i] = out[reflect_101(-i, w)];
        out[w - 1 + i] = out[reflect_101(w - 1 + i, w)];
    }
}

float filter_at(const float* row, int x) {
    return kernel_far * (row[x - 2] + row[x + 2]) + kernel_near * (row[x - 1] + row[x + 1]) + kernel_center * row[x];
}

/// Every `step`-th pixel of the image after the kernel in both axes.
template <int step>
Image<float> filter(const Image<float>& image) {
    Image<float> out((image.width + step - 1) / step, (image.height + step - 1) / step);
    parallel_rows(out.height, rows_per_band, [&](int begin, int end) {
        std::vector<float> columns(image.width + 2 * padding);
        float* const filtered = columns.data() + padding;
        for (int y = begin; y < end; ++y) {
            filter_columns(image, step * y, filtered);
            float* const row = out.row(y);
            for (int x = 0; x < out.width; ++x) row[x] = image.width == 1 ? filtered[0] : filter_at(filtered, step * x);
        }
    });
    return out;
}

/// Index of coarse sample i reflected at the borders of the finer axis: fine position 2i stays even.
int reflect_coarse(int i, int fine) {
    return reflect_101(2 * i, fine) / 2;
}

/// Expands one row along x: `coarse` has a pad of one float on both sides, filled here.
void expand_along_row(float* coarse, int coarse_width, float* out, int fine_width) {
    if (coarse_width == 1) {
        std::fill_n(out, fine_width, coarse[0]);
        return;
    }
    coarse[-1] = coarse[reflect_coarse(-1, fine_width)];
    coarse[coarse_width] = coarse[reflect_coarse(coarse_width, fine_width)];
    const int pairs = fine_width / 2;
    for (int i = 0; i < pairs; ++i) {
        out[2 * i] = 2 * kernel_far * (coarse[i - 1] + coarse[i + 1]) + 2 * kernel_center * coarse[i];
        out[2 * i + 1] = 2 * kernel_near * (coarse[i] + coarse[i + 1]);
    }
    if (fine_width % 2 != 0) {
        const int i = pairs;
        out[2 * i] = 2 * kernel_far * (coarse[i - 1] + coarse[i + 1]) + 2 * kernel_center * coarse[i];
    }
}

/// Some rows of a level: row y lies at data + (y - first) * size.width.
struct RowWindow {
    const float* data;
    int first;
    LevelSize size;  ///< of the whole level
};

/// Fine rows [begin, end) from a window that holds every coarse row they need. `column_sums`: coarse width + 2 floats.
void expand_window(const RowWindow& coarse, LevelSize fine_size, int begin, int end, float* out, float* column_sums) {
    const int w = coarse.size.width;
    const auto row = [&](int i) {
        const int y = reflect_coarse(i, fine_size.height) - coarse.first;
        return coarse.data + std::ptrdiff_t{y} * w;
    };
    float* const sums = column_sums + 1;
    for (int y = begin; y < end; ++y, out += fine_size.width) {
        const int i = y / 2;
        const float* const center = row(i);
        if (coarse.size.height == 1) {
            std::copy_n(center, w, sums);
        } else if (y % 2 == 0) {
            const float* const up = row(i - 1);
            const float* const down = row(i + 1);
            for (int x = 0; x < w; ++x) {
                sums[x] = 2 * kernel_far * (up[x] + down[x]) + 2 * kernel_center * center[x];
            }
        } else {
            const float* const down = row(i + 1);
            for (int x = 0; x < w; ++x) sums[x] = 2 * kernel_near * (center[x] + down[x]);
        }
        expand_along_row(sums, w, out, fine_size.width);
    }
}

}  // namespace

int reflect_101(int i, int n) {
    if (n == 1) return 0;
    const int period = 2 * (n - 1);
    i %= period;
    if (i < 0) i += period;
    return i < n ? i : period - i;
}

std::vector<LevelSize> pyramid_sizes(int width, int height, int count) {
    std::vector<LevelSize> sizes;
    LevelSize size{width, height};
    for (int level = 0; level < count; ++level) {
        sizes.push_back(size);
        size = {half_size(size.width), half_size(size.height)};
    }
    return sizes;
}

Image<float> low_pass(const Image<float>& image) {
    return filter<1>(image);
}

Image<float> reduce(const Image<float>& image) {
    return filter<2>(image);
}

Image<float> difference(const Image<float>& a, Image<float> b) {
    for (std::size_t i = 0; i < b.size(); ++i) b.pixels[i] = a.pixels[i] - b.pixels[i];
    return b;
}

Image<float> expand(const Image<float>& image, LevelSize fine) {
    Image<float> out(fine.width, fine.height);
    const RowWindow coarse{image.pixels.data(), 0, {image.width, image.height}};
    parallel_rows(fine.height, rows_per_band, [&](int begin, int end) {
        std::vector<float> sums(image.width + 2);
        expand_window(coarse, fine, begin, end, out.row(begin), sums.data());
    });
    return out;
}

std::vector<Image<float>> make_gaussian_pyramid(Image<float> image, int count) {
    std::vector<Image<float>> levels = {std::move(image)};
    while (static_cast<int>(levels.size()) < count) levels.push_back(reduce(levels.back()));
    return levels;
}

Image<float> expand_to_level(const Image<float>& image, const std::vector<LevelSize>& sizes, int from, int to) {
    Image<float> out = image;
    for (int level = from - 1; level >= to; --level) out = expand(out, sizes[level]);
    return out;
}

void RowExpander::load(const Image<float>& image, int level, int begin, int end) {
    struct Range {
        int begin, end;
    };
    // Which rows every level must give, from fine to coarse.
    std::vector<Range> ranges = {{begin, end}};
    for (int l = 1; l < level; ++l) {
        const Range fine = ranges.back();
        const int height = (*sizes_)[l].height;
        ranges.push_back({std::max(0, fine.begin / 2 - 1), std::min(height, (fine.end - 1) / 2 + 2)});
    }
    RowWindow window{image.pixels.data(), 0, {image.width, image.height}};
    for (int l = level - 1; l >= 1; --l) {
        const LevelSize fine = (*sizes_)[l];
        const Range rows = ranges[l];
        std::vector<float>& buffer = buffers_[l];
        buffer.resize(static_cast<std::size_t>(rows.end - rows.begin) * static_cast<std::size_t>(fine.width));
        column_sums_.resize(window.size.width + 2);
        expand_window(window, fine, rows.begin, rows.end, buffer.data(), column_sums_.data());
        window = {buffer.data(), rows.begin, fine};
    }
    expands_ = level > 0;
    rows_ = window.data;
    first_row_ = window.first;
    if (expands_) column_sums_.resize((*sizes_)[1].width + 2);
}

void RowExpander::expand_row(int y, float* out) {
    if (expands_) {
        expand_window({rows_, first_row_, (*sizes_)[1]}, sizes_->front(), y, y + 1, out, column_sums_.data());
    } else {
        const int width = sizes_->front().width;
        std::copy_n(rows_ + std::ptrdiff_t{y - first_row_} * width, width, out);
    }
}

}  // namespace aleph
