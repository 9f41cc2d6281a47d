#pragma once
// An error that is known in a part of a picture, continued smoothly beyond it.

#include "engine/base/color.h"
#include "render/pixels/picture_part.h"

namespace aleph {

/// The error itself in the part; elsewhere means of what is near, over wider areas the farther away it is (push and
/// pull, Gortler et al. 1996). So an error that is even in the part is even everywhere: the part's outline is no edge
/// of it. Values that are not finite count as unknown. 0 if nothing is known.
Image<Rgb> continue_error(const Image<Rgb>& error, const PicturePart& part);

}  // namespace aleph
