#pragma once
// Motion between two pictures, found by a search for what looks alike, and checked by the search back.

#include "motion/flow.h"
#include "motion/image_motion.h"

namespace aleph {

/// How two pictures are compared.
enum class PictureSearch {
    census,   ///< as Yee 2000 prints it (image_motion.h): every pixel is `valid`
    checked,  ///< the same, with the check
    flow,     ///< optical flow (flow.h), with the check
};

/// A picture prepared for a search, once for a frame, which is first N+1 and then N.
struct SearchedPicture {
    CensusPyramid census;      ///< of the searches by census
    Image<std::uint8_t> grey;  ///< of optical flow
};

/// @throws InputError if the picture is empty
SearchedPicture prepare_picture(const Image<Rgb>& picture, PictureSearch search);

/// Motion from the first of two pictures to the second. The check: a pixel is `valid` if the motion found where it
/// arrives leads back to it, to within sqrt(.01 (a^2 + b^2) + .5) pixels for motions of lengths a and b (Sundaram et
/// al., "Dense Point Trajectories by GPU-Accelerated Large Displacement Optical Flow", ECCV 2010). Otherwise it has
/// `no_counterpart` and does not move; where the motion leads out of the picture, nothing can be checked:
/// `leaves_screen`.
/// @throws InputError as compute_image_motion and compute_flow
MotionField compute_picture_motion(const SearchedPicture& first, const SearchedPicture& second, PictureSearch search);

struct PictureMotions {
    MotionField there, back;
};

/// The same, and from the second picture to the first; the searches are shared.
PictureMotions compute_picture_motions(const SearchedPicture& first, const SearchedPicture& second,
                                       PictureSearch search);

/// A motion to the frame before as one from there, and the reverse.
void turn_round(MotionField& field);

}  // namespace aleph
