#pragma once
// The effects that were left out of each pixel, as colours.

#include "engine/base/image.h"
#include "engine/rays/hit.h"
#include "render/plan/effect_table.h"

namespace aleph {

/// For each pixel the mean colour of the effects that its surface has and that are left out; black where all are
/// simulated, and behind all surfaces.
/// @param hits  first hits through the pixel centres
Image<Rgb> make_effect_picture(const Image<Hit>& hits, const FrameFacts& facts, const EffectsPlan& plan,
                               std::size_t instances, const EffectTable& table = effect_table());

}  // namespace aleph
