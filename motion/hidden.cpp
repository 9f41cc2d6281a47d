// Is a surface point hidden in the other frame? One ray for each from the other camera to the point.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "motion/model_motion.h"
#include "motion/reprojection.h"

namespace aleph {
namespace {

// Blocks of neighbouring pixels: their points lie close together, so do the rays.
constexpr int hidden_block = 8;

/// A point of a surface in the other frame, on its way from the camera.
struct AimedPoint {
    std::size_t pixel = 0;
    glm::dvec3 way{0.0};    ///< unit, camera axes
    double distance = 0.0;  ///< m
    /// How far, across the way, the ray may miss the point because positions and directions are rounded, m.
    double resolution = 0.0;
};

/// Points of one block of pixels, and the first hits on the way to them.
struct AimedBlock {
    std::size_t count = 0;
    std::array<AimedPoint, hidden_block * hidden_block> points;
    std::array<Ray, hidden_block * hidden_block> rays;
    std::array<Hit, hidden_block * hidden_block> met;
};

/// The triangle that a hit names, in the camera's axes, m.
struct PlacedTriangle {
    std::array<glm::dvec3, 3> corners;

    PlacedTriangle(const Scene& scene, const PosedView& view, const Hit& hit) {
        const auto [node, number] = view.pose.instances[hit.instance];
        const Mesh& mesh = scene.meshes[number];
        const std::vector<glm::dvec3>& moved = view.pose.meshes[number].positions;
        const CameraFromObject map = make_camera_from_object(view.view, view.pose.world[node]);
        const glm::uvec3& t = mesh.triangles[hit.primitive];
        for (int k = 0; k < 3; ++k) corners[k] = map(moved.empty() ? glm::dvec3(mesh.positions[t[k]]) : moved[t[k]]);
    }

    glm::dvec3 unit_normal() const {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        return normal / glm::length(normal);
    }
    /// How far its corners reach from a place.
    double reach(const glm::dvec3& from) const {
        return std::max(
            {glm::distance(corners[0], from), glm::distance(corners[1], from), glm::distance(corners[2], from)});
    }
};

class HiddenPoints {
  public:
    HiddenPoints(const Scene& scene, const PosedView& other, const Image<Hit>& hits, const RayScene& rays)
        : scene_(scene), other_(other), hits_(hits), rays_(rays) {}

    /// Adds a pixel whose point is to be found.
    void add(std::size_t pixel, AimedBlock& block) const {
        const Hit& hit = hits_.pixels[pixel];
        const auto [node, mesh] = other_.pose.instances[hit.instance];
        const CameraView& view = other_.view;
        const CameraFromObject map = make_camera_from_object(view, other_.pose.world[node]);
        const PosedMesh& posed = other_.pose.meshes[mesh];
        const glm::dvec3 target = map(triangle_point(scene_.meshes[mesh], posed, hit));
        const glm::dvec3 start = view.orthographic ? glm::dvec3(target.x, target.y, 0.0) : glm::dvec3(0.0);
        const glm::dvec3 origin = (view.position - rays_.anchor()) + view.axes * start;
        AimedPoint& aimed = block.points[block.count];
        aimed.pixel = pixel;
        aimed.distance = glm::length(target - start);
        aimed.way = (target - start) / aimed.distance;
        // Corners of trees in the world, and of what deforms, are rounded too.
        double sizes = glm::length(origin) + aimed.distance;
        const bool flat = rays_.is_flat(hit.instance);
        if (flat || !posed.positions.empty())
            sizes +=
                PlacedTriangle(scene_, other_, hit).reach(flat ? to_camera(view, rays_.flat_origin()) : map.offset);
        constexpr double rounding = 0x1p-22;  // four times that of single precision
        aimed.resolution = std::min(rounding * sizes, largest_gap * aimed.distance);

        Ray& ray = block.rays[block.count++];
        ray.origin = glm::vec3(origin);
        ray.direction = glm::vec3(view.axes * aimed.way);
        ray.far = static_cast<float>(aimed.distance * (1.0 + largest_gap));
    }

    /// True where what is met first lies before the point by more than rounding explains. Two surfaces that touch in
    /// the point may be met that far apart, each along its slope. Between triangles of one surface of which one shows
    /// its front and the other its back, there is the body that they enclose.
    bool is_hidden(const AimedPoint& aimed, const Hit& met) const {
        const Hit& own = hits_.pixels[aimed.pixel];
        if (met.instance == no_index || (met.instance == own.instance && met.primitive == own.primitive)) return false;
        const double gap = aimed.distance - met.distance;
        if (!(gap > aimed.resolution)) return false;
        const double slope = glm::dot(PlacedTriangle(scene_, other_, own).unit_normal(), aimed.way);
        const double met_slope = glm::dot(PlacedTriangle(scene_, other_, met).unit_normal(), aimed.way);
        if (met.instance == own.instance && slope * met_slope < 0.0) return true;
        const double touching = aimed.resolution * (1.0 / std::abs(slope) + 1.0 / std::abs(met_slope));
        return gap > std::min(largest_gap * aimed.distance, touching);
    }

  private:
    /// The share of the distance by which two surfaces that touch are met apart at most.
    static constexpr double largest_gap = 1e-3;

    const Scene& scene_;
    const PosedView& other_;
    const Image<Hit>& hits_;
    const RayScene& rays_;
};

}  // namespace

std::uint64_t mark_hidden(MotionField& field, const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                          const RayScene& other_rays) {
    ALEPH_CHECK(same_size(field.validity, hits), fmt::format("{}x{} motion, {}x{} hits", field.validity.width,
                                                             field.validity.height, hits.width, hits.height));
    const HiddenPoints points(scene, other, hits, other_rays);
    const int rows = (hits.height + hidden_block - 1) / hidden_block;
    std::vector<std::uint64_t> rays_of_row(static_cast<std::size_t>(rows), 0);
    const auto mark_block = [&](Tracer& tracer, AimedBlock& block, int left, int top) {
        block.count = 0;
        for (int y = top; y < std::min(top + hidden_block, hits.height); ++y) {
            for (int x = left; x < std::min(left + hidden_block, hits.width); ++x) {
                const std::size_t pixel = hits.index(x, y);
                if (field.validity.pixels[pixel] == MotionValidity::valid) points.add(pixel, block);
            }
        }
        tracer.intersect({block.rays.data(), block.count}, {block.met.data(), block.count});
        for (std::size_t i = 0; i < block.count; ++i) {
            if (points.is_hidden(block.points[i], block.met[i]))
                field.validity.pixels[block.points[i].pixel] = MotionValidity::hidden;
        }
        return block.count;
    };
    parallel_rows(rows, 1, [&](int begin, int end) {
        Tracer tracer(other_rays);
        AimedBlock block;
        for (int row = begin; row < end; ++row) {
            for (int left = 0; left < hits.width; left += hidden_block)
                rays_of_row[row] += mark_block(tracer, block, left, row * hidden_block);
        }
    });
    return std::accumulate(rays_of_row.begin(), rays_of_row.end(), std::uint64_t{0});
}

}  // namespace aleph
