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

/// The place in the camera's axes of what a hit names, and its triangle's normal there: not unit, m^2.
struct PlacedTriangle {
    const Mesh& mesh;
    const PosedMesh& posed;
    CameraFromObject map;

    glm::dvec3 point(const Hit& hit) const { return map(triangle_point(mesh, posed, hit)); }
    glm::dvec3 normal(int primitive) const {
        const glm::uvec3& t = mesh.triangles[primitive];
        const auto corner = [&](unsigned v) {
            return map.linear * (posed.positions.empty() ? glm::dvec3(mesh.positions[v]) : posed.positions[v]);
        };
        const glm::dvec3 first = corner(t.x);
        return glm::cross(corner(t.y) - first, corner(t.z) - first);
    }
};

class HiddenPoints {
  public:
    HiddenPoints(const Scene& scene, const PosedView& other, const Image<Hit>& hits, const RayScene& rays)
        : scene_(scene), other_(other), hits_(hits), rays_(rays) {}

    /// Adds a pixel whose point is to be found.
    void add(std::size_t pixel, AimedBlock& block) const {
        const Hit& hit = hits_.pixels[pixel];
        const PlacedTriangle place = find(hit.instance);
        const CameraView& view = other_.view;
        const glm::dvec3 target = place.point(hit);
        const glm::dvec3 start = view.orthographic ? glm::dvec3(target.x, target.y, 0.0) : glm::dvec3(0.0);
        const glm::dvec3 origin = (view.position - rays_.anchor()) + view.axes * start;
        AimedPoint& aimed = block.points[block.count];
        aimed.pixel = pixel;
        aimed.distance = glm::length(target - start);
        aimed.way = (target - start) / aimed.distance;
        double sizes = glm::length(origin) + aimed.distance + glm::length(target - place.map.offset);
        if (rays_.is_flat(hit.instance))
            sizes += glm::length(view.axes * target + (view.position - rays_.flat_origin()));
        aimed.resolution = 0x1p-22 * sizes;  // four times the rounding of single precision

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
        const double slope = glm::dot(find_unit_normal(own), aimed.way);
        const double met_slope = glm::dot(find_unit_normal(met), aimed.way);
        if (met.instance == own.instance && slope * met_slope < 0.0) return true;
        const double touching = aimed.resolution * (1.0 / std::abs(slope) + 1.0 / std::abs(met_slope));
        return gap > std::min(largest_gap * aimed.distance, touching);
    }

  private:
    /// The share of the distance by which two surfaces that touch are met apart at most.
    static constexpr double largest_gap = 1e-3;

    PlacedTriangle find(int instance) const {
        const auto [node, mesh] = other_.pose.instances[instance];
        return {scene_.meshes[mesh], other_.pose.meshes[mesh],
                make_camera_from_object(other_.view, other_.pose.world[node])};
    }

    glm::dvec3 find_unit_normal(const Hit& hit) const {
        const glm::dvec3 normal = find(hit.instance).normal(hit.primitive);
        return normal / glm::length(normal);
    }

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
