// The blade: an airfoil swept along a smooth V.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/boomerang/boomerang_scene.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

constexpr double reach = 0.33;           // m, of an arm along x
constexpr double slope = 0.72;           // of the arms: they open by 108 degrees
constexpr double elbow = 0.075;          // m; larger values give a rounder elbow
constexpr double chord = 0.092;          // m: width of the blade
constexpr double top = 0.0095;           // m: height of the arched side
constexpr double bottom = 0.0025;        // m: depth of the flat side
constexpr double tip = 0.08;             // share of the blade's length over which a tip is rounded
constexpr int stations = 56, sides = 9;  // along the blade; across each of its two faces

/// The middle line at an x: a branch of a hyperbola in x and z.
glm::dvec2 middle_line(double x) {
    return {x, std::sqrt(elbow * elbow + slope * slope * x * x)};
}

/// The middle line by arc length.
class MiddleLine {
  public:
    MiddleLine() {
        constexpr int steps = 4000;
        glm::dvec2 previous = middle_line(-reach);
        double length = 0.0, moment = 0.0;
        for (int i = 0; i <= steps; ++i) {
            const glm::dvec2 at = middle_line(reach * (2.0 * i / steps - 1.0));
            const double step = glm::distance(previous, at);
            length += step;
            moment += step * 0.5 * (at.y + previous.y);
            points_.push_back(at);
            lengths_.push_back(length);
            previous = at;
        }
        centre_ = moment / length;
    }
    /// @param s  -1 at one tip, 0 at the elbow, 1 at the other
    glm::dvec2 at(double s) const {
        const double wanted = 0.5 * (s + 1.0) * lengths_.back();
        const auto above = std::lower_bound(lengths_.begin(), lengths_.end(), wanted);
        const auto i =
            std::clamp<std::size_t>(static_cast<std::size_t>(above - lengths_.begin()), 1, lengths_.size() - 1);
        const double t = (wanted - lengths_[i - 1]) / (lengths_[i] - lengths_[i - 1]);
        return glm::mix(points_[i - 1], points_[i], t) - glm::dvec2(0.0, centre_);
    }
    /// The unit normal in the plane, to the left of the direction from tip to tip.
    glm::dvec2 across(double s) const {
        const glm::dvec2 along = glm::normalize(at(std::min(s + 1e-3, 1.0)) - at(std::max(s - 1e-3, -1.0)));
        return {-along.y, along.x};
    }

  private:
    std::vector<glm::dvec2> points_;
    std::vector<double> lengths_;
    double centre_ = 0.0;
};

/// Relative width: about 1 along the blade, a little more at the elbow, round at the tips.
double width_at(double s) {
    const double left = std::max(0.0, 1.0 - std::abs(s));
    const double rounding = left < tip ? std::sqrt(std::max(0.0, 1.0 - (1.0 - left / tip) * (1.0 - left / tip))) : 1.0;
    return rounding * (1.0 + 0.16 * std::exp(-12.0 * s * s) - 0.1 * s * s);
}

/// A point of the surface. `turn` goes around the section: 0 is the leading edge, pi the trailing one, the upper side
/// is between.
glm::dvec3 surface(const MiddleLine& line, double s, double turn) {
    const double width = width_at(s), side = std::sin(turn);
    // The highest point is near the leading edge, as on a wing.
    const double lead = std::cos(turn) + (side > 0.0 ? 0.22 * side * side : 0.0);
    const glm::dvec2 at = line.at(s) + 0.5 * chord * width * lead * line.across(s);
    return {at.x, width * side * (side > 0.0 ? top : bottom), at.y};
}

glm::vec3 normal_at(const MiddleLine& line, double s, double turn) {
    constexpr double ds = 1e-4, dt = 1e-3;
    const double inside = std::clamp(s, -1.0 + 1e-3, 1.0 - 1e-3);  // tips are points
    const glm::dvec3 along = surface(line, inside + ds, turn) - surface(line, inside - ds, turn);
    const glm::dvec3 around = surface(line, inside, turn + dt) - surface(line, inside, turn - dt);
    const glm::dvec3 n = glm::normalize(glm::cross(along, around));
    return glm::vec3(glm::floor(n * 1e4 + 0.5) / 1e4);
}

/// Stations along the blade are closer together at the round tips.
double station_at(int i) {
    const double t = static_cast<double>(i) / stations;
    return -std::cos(pi * t) * 0.35 + (2.0 * t - 1.0) * 0.65;
}

}  // namespace

Mesh make_boomerang_mesh(int material) {
    const MiddleLine line;
    Mesh mesh;
    mesh.name = "boomerang";
    mesh.material = material;
    // Two faces, each a grid; along the edges both have the same points and normals.
    for (const double face : {0.0, 1.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int i = 0; i <= stations; ++i) {
            for (int k = 0; k <= sides; ++k) {
                const double s = station_at(i), share = static_cast<double>(k) / sides, turn = pi * (face + share);
                mesh.positions.push_back(glm::vec3(to_millionth(surface(line, s, turn))));
                mesh.normals.push_back(normal_at(line, s, turn));
                const double v = 0.5 * (face + (face == 0.0 ? share : 1.0 - share));
                mesh.uv[0].push_back(glm::vec2(glm::floor(glm::dvec2(0.5 * (s + 1.0), v) * 1e4 + 0.5) / 1e4));
            }
        }
        const auto at = [&](int i, int k) { return first + static_cast<std::uint32_t>(i * (sides + 1) + k); };
        for (int i = 0; i < stations; ++i) {
            for (int k = 0; k < sides; ++k) {
                // A tip is one point: half of the triangles at a tip have no area and are left out.
                if (i > 0) mesh.triangles.emplace_back(at(i, k), at(i + 1, k), at(i, k + 1));
                if (i + 1 < stations) mesh.triangles.emplace_back(at(i, k + 1), at(i + 1, k), at(i + 1, k + 1));
            }
        }
    }
    return mesh;
}

}  // namespace aleph
