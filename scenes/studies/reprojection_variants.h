#pragma once
// The reprojection of model-based motion in several precisions, for the study of what double buys. All variants take
// poses in double; they differ in where they round.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/pose/camera_view.h"

namespace aleph {

/// Projection by a camera's lens in the precision T.
template <class T>
struct LensOf {
    T pixels_per_unit{}, middle_x{}, middle_y{};
    bool orthographic = false;

    explicit LensOf(const CameraView& view)
        : pixels_per_unit(static_cast<T>(view.pixels_per_unit)),
          middle_x(static_cast<T>(0.5 * view.width + view.axis_offset.x)),
          middle_y(static_cast<T>(0.5 * view.height + view.axis_offset.y)),
          orthographic(view.orthographic) {}

    /// @param p  m, camera axes
    /// @return pixels, y down
    glm::vec<2, T> project(const glm::vec<3, T>& p) const {
        const T scale = orthographic ? pixels_per_unit : pixels_per_unit / -p.z;
        return {middle_x + p.x * scale, middle_y - p.y * scale};
    }
};

/// The camera's position is subtracted from the object's in the precision Difference, and all else is done in T: float
/// relative to the camera for <float, double>, the motion of this project for <double, double>.
template <class T, class Difference>
class RelativeReprojection {
  public:
    RelativeReprojection(const CameraView& view, const glm::dmat4& world_from_object) : lens_(view) {
        using Wide = glm::vec<3, Difference>;
        const glm::mat<3, 3, Difference> axes(view.axes), object{glm::dmat3(world_from_object)};
        linear_ = glm::mat<3, 3, T>(glm::transpose(axes) * object);
        offset_ = glm::vec<3, T>((Wide(glm::dvec3(world_from_object[3])) - Wide(view.position)) * axes);
    }
    /// @param point  m, object space
    glm::vec<2, T> operator()(const glm::dvec3& point) const {
        return lens_.project(linear_ * glm::vec<3, T>(point) + offset_);
    }

  private:
    LensOf<T> lens_;
    glm::mat<3, 3, T> linear_{T(1)};
    glm::vec<3, T> offset_{T(0)};
};

/// The point is moved to world space, and from there to the camera's axes, all in T.
template <class T>
class WorldReprojection {
  public:
    WorldReprojection(const CameraView& view, const glm::dmat4& world_from_object)
        : lens_(view), world_from_object_(world_from_object), position_(view.position), axes_(view.axes) {}
    /// @param point  m, object space
    glm::vec<2, T> operator()(const glm::dvec3& point) const {
        const glm::vec<3, T> world(world_from_object_ * glm::vec<4, T>(glm::vec<3, T>(point), T(1)));
        return lens_.project((world - position_) * axes_);
    }

  private:
    LensOf<T> lens_;
    glm::mat<4, 4, T> world_from_object_;
    glm::vec<3, T> position_;
    glm::mat<3, 3, T> axes_;
};

/// A pose moved by an offset in double, as authored coordinates would be.
inline glm::dmat4 moved_by(glm::dmat4 world, const glm::dvec3& offset) {
    world[3] += glm::dvec4(offset, 0.0);
    return world;
}
inline CameraView moved_by(CameraView view, const glm::dvec3& offset) {
    view.position += offset;
    return view;
}

}  // namespace aleph
