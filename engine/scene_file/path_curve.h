#pragma once
// A smooth curve through points, by the distance along it.

#include <glm/vec3.hpp>
#include <vector>

namespace aleph {

/// A centripetal Catmull-Rom curve (Yuksel, Schaefer and Keyser 2011, Computer-Aided Design 43(7)): it passes through
/// every point without loops or cusps between them. A point that is listed twice in a row is a corner.
class PathCurve {
  public:
    /// @param closed  the curve goes on from the last point to the first
    PathCurve(const std::vector<glm::dvec3>& points, bool closed);

    /// Length of the whole curve, m; 0 where all points coincide.
    double length() const { return distances_.empty() ? 0.0 : distances_.back(); }
    /// Points without repetitions.
    std::size_t point_count() const { return points_.size(); }

    struct Place {
        glm::dvec3 position{0.0};
        glm::dvec3 direction{0.0};  ///< unit, the way the points go; zero where the curve turns back
    };
    /// @param distance  m along the curve; what lies outside is at its ends. The length must be above 0.
    Place at(double distance) const;

  private:
    /// From a point to the next, over u from 0 to 1.
    struct Segment {
        glm::dvec3 start{0.0}, end{0.0};
        glm::dvec3 leaving{0.0}, arriving{0.0};  ///< derivatives by u
    };

    void take_points(const std::vector<glm::dvec3>& points, bool closed);
    void make_segments(bool closed);
    void add_distances();
    static glm::dvec3 derivative(const Segment& segment, double u);
    static double arc_length(const Segment& segment, double from, double to);

    std::vector<glm::dvec3> points_;
    std::vector<bool> corners_;
    std::vector<Segment> segments_;
    std::vector<double> distances_;  ///< from the start, at every piece of every segment
};

}  // namespace aleph
