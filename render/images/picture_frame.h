#pragma once
// A frame that another program rendered: its colour, and its motion and depth if the file has them.
//
// Layers are channel names up to their last dot: "ViewLayer.Combined.R" is channel R of the layer "ViewLayer.Combined".

#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/color.h"
#include "motion/motion_field.h"

namespace aleph {

/// Layers by name; empty: found in the file. "none": not read (motion and depth).
struct PictureLayers {
    std::string color;
    std::string motion;
    std::string depth;
};

struct PictureFrame {
    /// Linear RGB. EXR and HDR: the values as they are, taken as Rec.709; alpha is ignored, because colour is already
    /// multiplied by it. PNG and JPEG: decoded from sRGB and multiplied by alpha. Grey if the layer has only Y.
    Image<Rgb> color;
    std::optional<MotionField> motion;    ///< from this frame to the next
    std::optional<MotionField> backward;  ///< from this frame to the one before; only with `motion`
    Image<float> depth;                   ///< m, as in the file; empty: none
};

/// Colour: the layer that is named; else channels R, G, B or Y outside of layers; else the only layer with such
/// channels; else the only one of them called "Combined".
/// Motion: channels u and v, pixels, x right, y up, to the next frame; if the layer is "forward", with motion.valid,
/// and with velocity.image, which tells the length of the path where the file has framesPerSecond and pixelsPerDegree;
/// or X, Y, Z and W, where Z and W are this frame's position minus the next one's (Blender's Vector pass). Not named:
/// the layer "forward", or the only one called "Vector". Motion to the frame before: the layer "backward" beside
/// "forward"; X and Y beside Z and W. Depth: channel Z of the layer that is named; else Z outside of layers; else that
/// of the only layer called "Depth". Pixels at 1e10 m and beyond that do not move are background.
/// @throws InputError: unreadable, no such layer, or several among which one has to be named
PictureFrame read_picture_frame(const std::filesystem::path& path, const PictureLayers& layers = {});

}  // namespace aleph
