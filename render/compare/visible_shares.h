#pragma once
// How much of pictures shows a visible difference.

#include <cstddef>
#include <optional>

#include "render/compare/visible_difference.h"

namespace aleph {

/// Shares of pixels with a difference of at least one just visible difference, percent.
struct VisibleShares {
    double seen = 0.0, flicker = 0.0, lasting = 0.0;
    /// Of `seen`, each pixel weighed by how likely viewers look there; nothing where saliency is not known.
    std::optional<double> noticed{};
};

/// Counts over any number of frames.
class VisibleCount {
  public:
    /// @param saliency  [0,1], of the frame's size, or null
    void add(const VisibleMaps& maps, const Image<float>* saliency);
    VisibleShares shares() const;
    std::size_t pixels() const { return pixels_; }

  private:
    std::size_t pixels_ = 0, seen_ = 0, flicker_ = 0, lasting_ = 0;
    double noticed_ = 0.0, looked_ = 0.0;
    bool has_saliency_ = true;
};

/// @throws InputError if either has no R, G, B
PicturePair read_pair(const ChannelImage& a, const ChannelImage& b);

/// What a viewer sees of the differences between two still pictures: nothing flickers.
/// @param maps  of the reference (`aleph maps`), for its motion and how it is shown
/// @throws InputError if the pictures have no R, G, B, or sizes differ
VisibleMaps compare_stills(const ChannelImage& a, const ChannelImage& b, const ChannelImage& maps);

}  // namespace aleph
