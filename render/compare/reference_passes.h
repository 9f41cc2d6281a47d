#pragma once
// References as means of renderings with random numbers of their own, whose differences tell their noise.

#include "engine/image/image_file.h"

namespace aleph {

/// Renderings that a reference is the mean of.
double reference_passes(const ChannelImage& reference);

/// Adds a rendering, R, G and B, to a mean of others; variance.Y is the variance of the mean's luminance as their
/// differences tell it, infinite of one rendering; noise.R, noise.G and noise.B are the mean with alternating signs,
/// from which read_noise makes noise like the mean's own.
void add_pass(ChannelImage& mean, const ChannelImage& pass);

/// As it would be with the factor on radiance of another picture, if that has one.
ChannelImage with_exposure_of(ChannelImage picture, const ChannelImage& other);

}  // namespace aleph
