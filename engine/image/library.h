#pragma once
// The functions of OpenImageIO that this program uses, as a table. OpenImageIO needs some 260 libraries, which take a
// quarter of a second to load: the table is in a file of its own, loaded when the first picture needs it. Programs that
// link an installed aleph have the table linked in.

#include <functional>
#include <string>

#include "engine/image/codec.h"

namespace aleph {

enum class PixelType { bytes, floats };

/// Checks a size before decoding, and returns where the pixels go: row by row, channels together.
using PixelPlace = std::function<void*(int width, int height, int channels)>;

struct EncodedPicture {
    std::string format;  ///< "png" or "jpg"
    int width = 0, height = 0, channels = 0;
    const void* pixels = nullptr;  ///< row by row, channels together; alpha is not multiplied in
    PictureTexts attributes;       ///< by OpenImageIO's names, or texts of a PNG file
};

// Functions that return a text return the fault; empty if there is none. Colours to draw are display values in [0, 1].
struct ImageLibrary {
    std::string (*decode)(ByteView bytes, const std::string& format, PixelType type, const PixelPlace& place) = nullptr;
    std::string (*encode)(const EncodedPicture& picture, std::string& bytes) = nullptr;
    /// By a triangle filter.
    Image<Rgb> (*resize)(const Image<Rgb>& picture, int width, int height) = nullptr;
    /// Colours of positions 0 .. 1 on the scale "inferno".
    Image<Rgb> (*color_scale)(const Image<float>& positions) = nullptr;
    /// In pixels, for letters of `size` pixels; 0 without the font.
    int (*text_width)(const std::string& text, int size) = nullptr;
    /// Draws a text with its foot at y. x is its left end, or its right one. Without the font nothing is drawn.
    void (*draw_text)(Image<Rgb>& picture, int x, int y, bool x_is_right, const std::string& text, int size) = nullptr;
};

/// @throws InputError if the file with the table is missing or lacks a library
const ImageLibrary& image_library();

}  // namespace aleph

/// The table's file has this function alone.
extern "C" const aleph::ImageLibrary* aleph_image_library();
