#include "motion/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/pixel_loops.h"
#include "engine/rays/ray_scene.h"
#include "motion/reprojection.h"

namespace aleph {
namespace {

constexpr std::size_t batch = 1 << 16;  // triangles that are prepared together
constexpr double no_depth = std::numeric_limits<double>::infinity();

/// a x + b y + c of a place on the plane of unproject_pixel: 0 on an edge, positive inside.
struct Edge {
    double a = 0.0, b = 0.0, c = 0.0;

    /// The side that an edge belongs to. Of two triangles that share it, it is one's: they see it with opposite signs.
    bool owns() const { return a != 0.0 ? a > 0.0 : b != 0.0 ? b > 0.0 : c > 0.0; }
};

/// A triangle in camera axes, ready to be drawn.
struct Drawn {
    std::array<Edge, 3> edges;    ///< opposite to corners 0, 1 and 2
    std::array<bool, 3> owned{};  ///< Edge::owns
    /// Perspective: volume of the corners and the camera; depth is its quotient by the sum of the edges.
    double volume = 0.0;
    std::array<double, 3> depths{};                ///< of the corners, m
    int left = 0, right = 0, top = 0, bottom = 0;  ///< the pixels it may cover: [left, right), [top, bottom)
    int instance = no_index, primitive = no_index;
};

/// A camera, and the plane places of its pixel centres.
struct Screen {
    const CameraView& view;
    std::vector<double> x, y;
    double low_x, high_x, low_y, high_y;  ///< the picture with a pixel around it

    explicit Screen(const CameraView& v) : view(v), x(v.width), y(v.height) {
        for (int i = 0; i < v.width; ++i) x[i] = unproject_pixel(v, i + 0.5, 0.0).x;
        for (int i = 0; i < v.height; ++i) y[i] = unproject_pixel(v, 0.0, i + 0.5).y;
        const glm::dvec2 first = unproject_pixel(v, -1.0, -1.0),
                         last = unproject_pixel(v, v.width + 1.0, v.height + 1.0);
        low_x = first.x, high_x = last.x, low_y = last.y, high_y = first.y;
    }
};

using Corners = std::array<glm::dvec3, 3>;

/// Exactly the negative for exchanged ends, because nothing here is contracted.
Edge make_edge(const CameraView& view, const glm::dvec3& p, const glm::dvec3& q) {
    if (view.orthographic) return {p.y - q.y, q.x - p.x, p.x * q.y - p.y * q.x};
    const glm::dvec3 normal = glm::cross(p, q);
    return {normal.x, normal.y, -normal.z};
}

/// True if all corners lie beyond one side of the picture, or behind the camera.
bool is_outside(const Screen& screen, const Corners& p) {
    const auto all = [&](const auto& beyond) { return beyond(p[0]) && beyond(p[1]) && beyond(p[2]); };
    const auto reach = [&](const glm::dvec3& q) { return screen.view.orthographic ? 1.0 : -q.z; };
    return all([](const glm::dvec3& q) { return !(q.z < 0.0); }) ||
           all([&](const glm::dvec3& q) { return q.x < screen.low_x * reach(q); }) ||
           all([&](const glm::dvec3& q) { return q.x > screen.high_x * reach(q); }) ||
           all([&](const glm::dvec3& q) { return q.y < screen.low_y * reach(q); }) ||
           all([&](const glm::dvec3& q) { return q.y > screen.high_y * reach(q); });
}

/// Sets the pixels that a triangle may cover: all if it reaches behind the camera.
void set_bounds(const CameraView& view, const Corners& p, Drawn& drawn) {
    drawn.right = view.width;
    drawn.bottom = view.height;
    constexpr double smallest = 1e-12;  // m; a division by less may overflow
    const auto is_before = [](const glm::dvec3& q) { return -q.z > smallest; };
    if (!view.orthographic && !std::all_of(p.begin(), p.end(), is_before)) return;
    glm::dvec2 low(no_depth), high(-no_depth);
    for (const glm::dvec3& corner : p) {
        const glm::dvec2 at = project_camera_point(view, corner);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    // One pixel more on every side, for rounding.
    const auto whole = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, double(size))); };
    drawn.left = whole(std::floor(low.x) - 1.0, view.width);
    drawn.right = whole(std::ceil(high.x) + 1.0, view.width);
    drawn.top = whole(std::floor(low.y) - 1.0, view.height);
    drawn.bottom = whole(std::ceil(high.y) + 1.0, view.height);
}

/// Nothing for a triangle that cannot be seen.
std::optional<Drawn> prepare(const Screen& screen, const Corners& p) {
    if (is_outside(screen, p)) return std::nullopt;
    Drawn drawn;
    for (int k = 0; k < 3; ++k) drawn.edges[k] = make_edge(screen.view, p[(k + 1) % 3], p[(k + 2) % 3]);
    drawn.volume = screen.view.orthographic
                       ? (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)
                       : glm::dot(p[0], glm::cross(p[1] - p[0], p[2] - p[0]));
    if (!(std::abs(drawn.volume) > 0.0) || !std::isfinite(drawn.volume)) return std::nullopt;
    const double side = drawn.volume > 0.0 ? 1.0 : -1.0;
    drawn.volume *= side;
    for (int k = 0; k < 3; ++k) {
        Edge& edge = drawn.edges[k];
        edge = {side * edge.a, side * edge.b, side * edge.c};
        drawn.owned[k] = edge.owns();
        drawn.depths[k] = -p[k].z;
    }
    set_bounds(screen.view, p, drawn);
    return drawn;
}

float keep_eight_bits(double coordinate) {
    return static_cast<float>(std::floor(coordinate * 255.0 + 0.5) / 255.0);
}

/// Draws some rows of a triangle over what is nearest so far. A pixel without a hit is infinitely far.
void draw(const Screen& screen, const Drawn& drawn, int begin, int end, Image<Hit>& items, Image<double>& nearest) {
    const auto& [e0, e1, e2] = drawn.edges;
    for (int y = std::max(begin, drawn.top); y < std::min(end, drawn.bottom); ++y) {
        const double r0 = e0.b * screen.y[y] + e0.c, r1 = e1.b * screen.y[y] + e1.c, r2 = e2.b * screen.y[y] + e2.c;
        for (int x = drawn.left; x < drawn.right; ++x) {
            const double w = e0.a * screen.x[x] + r0, u = e1.a * screen.x[x] + r1, v = e2.a * screen.x[x] + r2;
            if (!(w >= 0.0 && u >= 0.0 && v >= 0.0)) continue;
            if ((w == 0.0 && !drawn.owned[0]) || (u == 0.0 && !drawn.owned[1]) || (v == 0.0 && !drawn.owned[2]))
                continue;
            const double sum = w + u + v;
            const double depth = screen.view.orthographic
                                     ? (w * drawn.depths[0] + u * drawn.depths[1] + v * drawn.depths[2]) / sum
                                     : drawn.volume / sum;
            if (!(depth > 0.0) || !(depth < nearest(x, y))) continue;
            nearest(x, y) = depth;
            items(x, y) = {drawn.instance, drawn.primitive, keep_eight_bits(u / sum), keep_eight_bits(v / sum),
                           static_cast<float>(depth)};
        }
    }
}

/// The triangles of all instances that are shown, numbered in order.
class TriangleList {
  public:
    TriangleList(const Scene& scene, const PosedView& posed) : scene_(scene), posed_(posed) {
        const ScenePose& pose = posed.pose;
        for (std::size_t i = 0; i < pose.instances.size(); ++i) {
            const auto [node, mesh] = pose.instances[i];
            if (pose.shown[i] == 0 || !is_traceable(pose.world[node])) continue;
            if (!are_traceable(pose.meshes[mesh].positions)) continue;
            objects_.push_back({static_cast<int>(i), count_, make_camera_from_object(posed.view, pose.world[node])});
            count_ += scene.meshes[mesh].triangles.size();
        }
    }

    std::size_t size() const { return count_; }

    /// The triangles from `begin` on that can be seen, in order.
    std::vector<Drawn> prepare_batch(const Screen& screen, std::size_t begin) const {
        std::vector<Drawn> drawn(std::min(batch, count_ - begin));
        parallel_for(drawn.size(), 1024, [&](std::size_t from, std::size_t to) {
            auto object = std::upper_bound(objects_.begin(), objects_.end(), begin + from,
                                           [](std::size_t n, const Object& o) { return n < o.first; });
            for (std::size_t i = from; i < to; ++i) {
                while (object != objects_.end() && object->first <= begin + i) ++object;
                const Object& own = *std::prev(object);
                const auto primitive = static_cast<int>(begin + i - own.first);
                if (const auto seen = prepare(screen, corners_of(own, primitive))) {
                    drawn[i] = *seen;
                    drawn[i].instance = own.instance;
                    drawn[i].primitive = primitive;
                }
            }
        });
        std::erase_if(drawn, [](const Drawn& d) { return d.instance == no_index; });
        return drawn;
    }

  private:
    struct Object {
        int instance;
        std::size_t first;  ///< number of its first triangle
        CameraFromObject place;
    };

    Corners corners_of(const Object& object, int primitive) const {
        const int number = posed_.pose.instances[object.instance].mesh;
        const Mesh& mesh = scene_.meshes[number];
        const std::vector<glm::dvec3>& moved = posed_.pose.meshes[number].positions;
        const glm::uvec3& triangle = mesh.triangles[primitive];
        Corners corners;
        for (int k = 0; k < 3; ++k) {
            corners[k] = object.place(moved.empty() ? glm::dvec3(mesh.positions[triangle[k]]) : moved[triangle[k]]);
        }
        return corners;
    }

    const Scene& scene_;
    const PosedView& posed_;
    std::vector<Object> objects_;
    std::size_t count_ = 0;
};

}  // namespace

Image<Hit> rasterize(const Scene& scene, const PosedView& posed) {
    const Screen screen(posed.view);
    Image<Hit> items(posed.view.width, posed.view.height);
    Image<double> nearest(items.width, items.height, no_depth);
    const TriangleList triangles(scene, posed);
    for (std::size_t begin = 0; begin < triangles.size(); begin += batch) {
        const std::vector<Drawn> drawn = triangles.prepare_batch(screen, begin);
        parallel_rows(items.height, rows_per_band, [&](int top, int bottom) {
            for (const Drawn& triangle : drawn) draw(screen, triangle, top, bottom, items, nearest);
        });
    }
    return items;
}

MotionField compute_raster_motion(ModelMotion& model, const Scene& scene, const PosedView& now, const PosedView& other,
                                  const Image<Hit>& items, OtherFrame which) {
    MotionField field = model.compute(now, other, items, which);
    const double sign = displacement_sign(which), longest = std::hypot(items.width, items.height);
    parallel_pixels(items, 8, [&](int x, int y) {
        const MotionValidity validity = field.validity(x, y);
        if (validity != MotionValidity::valid && validity != MotionValidity::leaves_screen) return;
        // Measured from the pixel's centre.
        const Hit& item = items(x, y);
        const auto [node, mesh] = now.pose.instances[item.instance];
        const CameraFromObject place = make_camera_from_object(now.view, now.pose.world[node]);
        const glm::dvec3 point = surface_point(scene.meshes[mesh], now.pose.meshes[mesh], item);
        const glm::dvec2 named = project_camera_point(now.view, place(point));
        glm::dvec2& displacement = field.displacement(x, y);
        const bool is_chord = field.path_length(x, y) == glm::length(displacement);
        displacement += sign * (named - glm::dvec2(x + 0.5, y + 0.5));
        const double length = glm::length(displacement);
        if (length > longest) displacement *= longest / length;
        if (is_chord) field.path_length(x, y) = std::min(length, longest);
    });
    return field;
}

}  // namespace aleph
