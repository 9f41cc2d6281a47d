// Finds the points of frame N that are hidden in frame N+1, with one ray each from the other camera to the point.

#include <fmt/format.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "motion/model_motion.h"
#include "motion/reprojection.h"

namespace aleph {
namespace {

/// A ray that ends just before the point, so that it does not hit the point's own surface: m, relative to the anchor.
Ray make_visibility_ray(const CameraView& view, const glm::dvec3& anchor, const glm::dvec3& in_camera) {
    constexpr double share_of_way = 1.0 - 1e-3;
    const glm::dvec3 start = view.orthographic ? glm::dvec3(in_camera.x, in_camera.y, 0.0) : glm::dvec3(0.0);
    const glm::dvec3 way = in_camera - start;
    const double distance = glm::length(way);
    Ray ray;
    ray.origin = glm::vec3((view.position - anchor) + view.axes * start);
    ray.direction = glm::vec3(view.axes * (way / distance));
    ray.far = static_cast<float>(distance * share_of_way);
    return ray;
}

}  // namespace

std::uint64_t mark_hidden(MotionField& field, const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                          const RayScene& other_rays) {
    ALEPH_CHECK(same_size(field.validity, hits), fmt::format("{}x{} motion, {}x{} hits", field.validity.width,
                                                             field.validity.height, hits.width, hits.height));
    const std::vector<Instance>& instances = other.pose.instances;

    // Blocks of neighbouring pixels: their points lie close together, so do the rays.
    constexpr int block = 8;
    const int columns = (hits.width + block - 1) / block, rows = (hits.height + block - 1) / block;
    std::vector<std::uint64_t> rays_of_row(static_cast<std::size_t>(rows), 0);
    const auto mark_block = [&](Tracer& tracer, int left, int top) -> std::size_t {
        std::size_t count = 0;
        int last = no_index;  // neighbours are mostly of one instance
        CameraFromObject map;
        for (int y = top; y < std::min(top + block, hits.height); ++y) {
            for (int x = left; x < std::min(left + block, hits.width); ++x) {
                const std::size_t pixel = hits.index(x, y);
                if (field.validity.pixels[pixel] != MotionValidity::valid) continue;
                const Hit& hit = hits.pixels[pixel];
                const auto [node, mesh] = instances[hit.instance];
                if (hit.instance != last) map = make_camera_from_object(other.view, other.pose.world[node]);
                last = hit.instance;
                const glm::dvec3 point = triangle_point(scene.meshes[mesh], other.pose.meshes[mesh], hit);
                ++count;
                if (tracer.occluded(make_visibility_ray(other.view, other_rays.anchor(), map(point))))
                    field.validity.pixels[pixel] = MotionValidity::hidden;
            }
        }
        return count;
    };
    parallel_rows(rows, 1, [&](int begin, int end) {
        Tracer tracer(other_rays);
        for (int row = begin; row < end; ++row) {
            for (int column = 0; column < columns; ++column) {
                rays_of_row[row] += mark_block(tracer, column * block, row * block);
            }
        }
    });
    return std::accumulate(rays_of_row.begin(), rays_of_row.end(), std::uint64_t{0});
}

}  // namespace aleph
