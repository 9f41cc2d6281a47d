#include "render/frame/blurred_estimate.h"

#include <cmath>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr float least_weight = 0.25f;  // of the pixels around a place that show its surface

/// The sharp estimate, read where it shows a given point.
class SharpReader {
  public:
    explicit SharpReader(const SharpEstimate& sharp)
        : sharp_(sharp), positions_(sharp.view.width, sharp.view.height, glm::vec3(0.0f)) {
        parallel_pixels(positions_, 16, [&](int x, int y) { place(x, y); });
    }

    /// Where a point lies in the picture, in pixels: 0 is the centre of the first one.
    std::optional<glm::dvec2> project(const SurfacePoint& point) const {
        const CameraView& view = sharp_.view;
        const glm::dvec3 seen = to_camera(view, sharp_.shading.anchor + glm::dvec3(point.position));
        if (!(-seen.z > view.near_plane)) return std::nullopt;
        const glm::dvec2 at = project_camera_point(view, seen) - 0.5;
        const bool inside = at.x > -1.0 && at.y > -1.0 && at.x < view.width && at.y < view.height;
        return inside ? std::optional(at) : std::nullopt;
    }

    /// From the four pixels around a place, of those that show the point's surface.
    /// @param at  project of the point
    /// @param footprint  size of a pixel there, m
    std::optional<Rgb> read(const SurfacePoint& point, int instance, const glm::dvec2& at, float footprint) const {
        const int left = static_cast<int>(std::floor(at.x)), top = static_cast<int>(std::floor(at.y));
        const glm::vec2 part(at.x - left, at.y - top);
        Rgb sum(0.0f);
        float weights = 0.0f;
        for (int i = 0; i < 4; ++i) {
            const int x = left + i % 2, y = top + i / 2;
            if (!shows(point, instance, footprint, x, y)) continue;
            const float weight = (i % 2 == 1 ? part.x : 1.0f - part.x) * (i / 2 == 1 ? part.y : 1.0f - part.y);
            sum += sharp_.picture(x, y) * weight;
            weights += weight;
        }
        return weights >= least_weight ? std::optional(sum / weights) : std::nullopt;
    }

  private:
    void place(int x, int y) {
        const Hit& hit = sharp_.centers.hits(x, y);
        if (hit.instance == no_index) return;
        const glm::vec3 direction(make_sample_ray(sharp_.view, sharp_.centers.place, x, y).direction);
        positions_(x, y) = make_surface_point(sharp_.shading, hit, direction).position;
    }

    bool shows(const SurfacePoint& point, int instance, float footprint, int x, int y) const {
        if (x < 0 || y < 0 || x >= sharp_.view.width || y >= sharp_.view.height) return false;
        if (sharp_.centers.hits(x, y).instance != instance) return false;
        return std::abs(glm::dot(point.geometric, positions_(x, y) - point.position)) <= footprint;
    }

    const SharpEstimate& sharp_;
    Image<glm::vec3> positions_;
};

/// One look through shutter and lens.
struct Look {
    const SharpEstimate& sharp;
    const SharpReader& reader;
    const NodeIrradiance* irradiance;
    const SampleScene& keyframe;

    /// Radiance without exposure of a surface that the sharp estimate does not show.
    Rgb shade(RayTask& task, const PixelSurface& surface, const std::optional<SurfacePoint>& still,
              const glm::dvec2& pixel) const {
        Rgb radiance = estimate_radiance(keyframe.lighting, task, surface, sharp.kind);
        if (irradiance == nullptr) return radiance;
        DiffuseSurface diffuse = make_diffuse_surface(surface);
        if (!(diffuse.footprint > 0.0f)) return radiance;
        if (still) {
            diffuse.position = still->position;
            diffuse.normal = still->normal;
        }
        return radiance + diffuse.reflected * irradiance->at(diffuse, pixel);
    }

    Rgb find(RayTask& task, const Hit& hit, const glm::vec3& direction, int x, int y) const {
        const auto exposure = static_cast<float>(sharp.exposure);
        if (hit.instance == no_index) {
            if (sharp.kind == EstimateKind::flat) return Rgb(exposure);
            return environment_radiance(keyframe.lighting.shading, direction) * exposure;
        }
        const SurfacePoint point = make_surface_point(keyframe.lighting.shading, hit, direction);
        const std::optional<SurfacePoint> still = carry_point(sharp.shading, hit, point);
        const std::optional<glm::dvec2> at = still ? reader.project(*still) : std::nullopt;
        if (at) {
            const float distance = sharp.view.orthographic ? 1.0f : hit.distance;
            const float footprint = distance / static_cast<float>(sharp.view.pixels_per_unit);
            if (const auto known = reader.read(*still, hit.instance, *at, footprint)) return *known;
        }
        const PixelSurface surface =
            make_pixel_surface(keyframe.lighting.shading, keyframe.view, SamplePlace{}, hit, direction, {x, y});
        return shade(task, surface, still, at.value_or(glm::dvec2(x, y))) * exposure;
    }
};

}  // namespace

Image<Rgb> blur_estimate(const SharpEstimate& sharp, const Lens& lens,
                         const std::function<SampleScene(double place)>& look_at, RayCounts& counts) {
    const int width = sharp.view.width, height = sharp.view.height;
    const SharpReader reader(sharp);
    const std::optional<NodeIrradiance> irradiance =
        sharp.nodes != nullptr ? std::optional<NodeIrradiance>(*sharp.nodes) : std::nullopt;
    Image<Rgb> blurred(width, height, Rgb(0.0f));
    Image<Hit> hits(width, height);
    for (int i = 0; i < blur_looks; ++i) {
        const double time = (i + 0.5) / blur_looks;
        const SampleScene keyframe = look_at(time);
        // Fibonacci's lattice of 8 points: even over times and lens.
        const glm::vec2 u(std::fmod(time * 3.0, 1.0), std::fmod(time * 5.0, 1.0));
        const auto make_ray = [&](int x, int y) {
            if (!(lens.radius > 0.0)) return make_camera_ray(keyframe.view, x + 0.5, y + 0.5);
            return make_lens_ray(keyframe.view, lens, {x + 0.5, y + 0.5}, u);
        };
        cast_rays(keyframe.lighting.rays, make_ray, Blend::cutout, hits);
        counts.primary += hits.size();
        const Look look{sharp, reader, irradiance ? &*irradiance : nullptr, keyframe};
        const auto look_at_row = [&](int y, RayTask& task) {
            for (int x = 0; x < width; ++x) {
                const glm::vec3 direction(make_ray(x, y).direction);
                blurred(x, y) += look.find(task, hits(x, y), direction, x, y) * (1.0f / blur_looks);
            }
        };
        cast_parallel(height, 4, keyframe.lighting.rays, counts, look_at_row, Blend::cutout);
    }
    return blurred;
}

}  // namespace aleph
