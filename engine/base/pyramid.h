#pragma once
// Gaussian pyramids (Burt and Adelson 1983) with the kernel {.05 .25 .4 .25 .05}, thesis 5.2. Borders are reflect-101
// (-1 is 1, n is n-2) on axes of any length. Coarse pixel i lies on fine pixel 2i.

#include <vector>

#include "engine/base/image.h"

namespace aleph {

struct LevelSize {
    int width = 0, height = 0;
    bool operator==(const LevelSize&) const = default;
};

/// Index of pixel i under reflect-101 on an axis of n pixels; any i, n >= 1.
int reflect_101(int i, int n);

/// Sizes of levels 0 .. count-1: each axis is ceil(n/2) of the one before; 1 stays 1.
std::vector<LevelSize> pyramid_sizes(int width, int height, int count);

/// The kernel in both axes, same size.
Image<float> low_pass(const Image<float>& image);

/// The next coarser level: low pass, then the even samples. An axis of size 1 is copied.
Image<float> reduce(const Image<float>& image);

/// The next finer level: zero insertion, then twice the kernel. `fine` reduces to the image's size.
/// An axis of size 1 is copied.
Image<float> expand(const Image<float>& image, LevelSize fine);

/// a - b, of one size.
Image<float> difference(const Image<float>& a, Image<float> b);

/// Levels 0 .. count-1; level 0 is the image itself.
std::vector<Image<float>> make_gaussian_pyramid(Image<float> image, int count);

/// Expands level `from` of a pyramid to the size of level `to` <= from, step by step.
Image<float> expand_to_level(const Image<float>& image, const std::vector<LevelSize>& sizes, int from, int to);

/// Expands a level to level 0 row by row: the same bits as expand_to_level, without a whole fine level in memory.
/// Its buffers are reused from one image to the next. Each thread needs its own.
class RowExpander {
  public:
    /// @param sizes  of all levels; must outlive the expander
    explicit RowExpander(const std::vector<LevelSize>& sizes) : sizes_(&sizes), buffers_(sizes.size()) {}

    /// Prepares rows [begin, end) of level 0. @param image  raster of `level`; must outlive their use
    void load(const Image<float>& image, int level, int begin, int end);

    /// Row y of level 0: sizes[0].width floats.
    void expand_row(int y, float* out);

  private:
    const std::vector<LevelSize>* sizes_;
    std::vector<std::vector<float>> buffers_;  ///< rows of levels between the raster's and 0
    std::vector<float> column_sums_;
    const float* rows_ = nullptr;  ///< of level 1, or of level 0 if the raster is that
    int first_row_ = 0;
    bool expands_ = false;
};

}  // namespace aleph
