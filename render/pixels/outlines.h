#pragma once
// Which pixels show more than one thing, told from pixel centres.

#include <cstdint>

#include "engine/base/image.h"
#include "engine/pose/camera_view.h"
#include "engine/rays/hit.h"
#include "motion/motion_field.h"
#include "render/surface/shading_scene.h"

namespace aleph {

/// Outline of a pixel: the faces that its centre and the eight around it show.
enum class Outline : std::uint8_t {
    none = 0,    ///< one face, evenly lit
    still = 1,   ///< several faces, which move alike, or a contrast
    moving = 2,  ///< several faces, some of which move differently
    small = 3,   ///< an object that is smaller than pixels may lie in it, or beside it
    strong = 4,  ///< as `still`, with a contrast of many times what is tolerated
};

/// Faces differ where pixel centres show several objects, or where one object has a step or a crease: along a plane the
/// inverse distance from a pinhole is linear in the picture, to second order in the angle of a pixel. A
/// step of half a pixel's size or more counts, or a crease of some 30 degrees.
/// No random number is involved, so that what depends on outlines, such as when a pixel stops, favours no samples.
Image<Outline> find_outlines(const CameraView& view, const Image<Hit>& hits, const MotionField& motion);

/// Marks the pixels that objects of at most 1.5 pixels' radius lie in, and those around them, as `small`: rays through
/// pixel centres, and the first samples, may miss the objects. Not where all these centres show something nearer.
/// @param hits  through pixel centres, of the view's size
void mark_small_objects(Image<Outline>& outlines, const CameraView& view, const Image<Hit>& hits,
                        const ShadingScene& shading);

/// Marks pixels without an outline as `still` where the luminances of the nine differ by more than half of what is
/// tolerated, as at shadows and in textures: a few samples of one pixel may miss what those of another meet. Where they
/// differ by more than eight times as much as is tolerated, as at the image of a lamp in a mirror, pixels without a
/// moving outline become `strong`: the error of a few samples would be seen even spread over the pixels around.
/// @param estimate   quick estimate of the frame, at pixel centres
/// @param threshold  cd/m2
/// @param tolerated  luminance of the estimate that is tolerated, per cd/m2 of the threshold
void mark_contrasts(Image<Outline>& outlines, const Image<Rgb>& estimate, const Image<float>& threshold,
                    double tolerated);

/// Returns whether both pixels have an outline, or neither has one: their samples vary alike.
/// @param outlines  empty: none has
inline bool are_alike(const Image<Outline>& outlines, int x, int y, int other_x, int other_y) {
    return outlines.empty() || (outlines(x, y) == Outline::none) == (outlines(other_x, other_y) == Outline::none);
}

}  // namespace aleph
