#pragma once
// The picture that an Alembic camera sees: its film window and field of view.

#include <glm/mat3x3.hpp>
#include <span>
#include <string>
#include <vector>

namespace aleph {

/// The 16 numbers of `.core`, by position.
enum AlembicCameraChannel {
    focal_length,         ///< mm
    horizontal_aperture,  ///< cm
    horizontal_offset,    ///< cm
    vertical_aperture,    ///< cm
    vertical_offset,      ///< cm
    lens_squeeze,
    overscan_left,  ///< fractions of the half frame
    overscan_right,
    overscan_top,
    overscan_bottom,
    f_stop,
    focus_distance,  ///< scene units
    shutter_open,    ///< s, relative to the frame
    shutter_close,   ///< s
    near_plane,      ///< scene units
    far_plane,       ///< scene units
    camera_channel_count
};

/// The part of the film that the picture shows, in units of half the frame's width.
struct FilmWindow {
    double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
};

/// The film window that a camera's 16 numbers describe, without overscan. @param film_back  applied to the corners
/// (column vectors)
FilmWindow film_window(std::span<const double> core, const glm::dmat3& film_back);

/// Film-back operations in file order: each text starts with t (2 channels), s (2) or m (9).
/// @throws std::invalid_argument for an unknown operation or channels that do not fit
glm::dmat3 film_back_matrix(const std::vector<std::string>& operations, std::span<const double> channels);

}  // namespace aleph
