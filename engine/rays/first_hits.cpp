#include "engine/rays/first_hits.h"

#include <array>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr int block_side = 4;  // 4 x 4 neighbouring pixels share a packet

}  // namespace

void cast_rays(const RayScene& scene, const std::function<CameraRay(int x, int y)>& make_ray, Blend blend,
               Image<Hit>& hits) {
    const int bands = (hits.height + block_side - 1) / block_side;
    parallel_for(static_cast<std::size_t>(bands), 1, [&](std::size_t band_begin, std::size_t band_end) {
        Tracer tracer(scene, blend);
        for (std::size_t band = band_begin; band < band_end; ++band) {
            const int y0 = static_cast<int>(band) * block_side;
            for (int x0 = 0; x0 < hits.width; x0 += block_side) {
                std::array<Ray, block_side * block_side> rays;
                std::array<Hit, block_side * block_side> found;
                std::size_t count = 0;
                const int y1 = std::min(y0 + block_side, hits.height), x1 = std::min(x0 + block_side, hits.width);
                for (int y = y0; y < y1; ++y) {
                    for (int x = x0; x < x1; ++x) rays[count++] = to_scene(scene, make_ray(x, y));
                }
                tracer.intersect(std::span(rays.data(), count), std::span(found.data(), count));
                count = 0;
                for (int y = y0; y < y1; ++y) {
                    for (int x = x0; x < x1; ++x) hits(x, y) = found[count++];
                }
            }
        }
    });
}

}  // namespace aleph
