#include "render/indirect_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "engine/base/parallel.h"
#include "render/gather.h"

namespace aleph {

namespace {

constexpr int gather_rays = 48;
constexpr double coarse_nodes = 300.0;  // about as many pixels are gathered first
constexpr int min_coarse_spacing = 8;   // pixels; closer, the noise of gathers would be finer than light itself
constexpr int max_levels = 4;           // each halves the spacing
constexpr float done = 0.999f;          // confidence at which no finer level is asked

float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Pixels at multiples of the finest spacing, where irradiance may be gathered. A coarser level has every 2nd, 4th ...
/// one.
class GatherGrid {
  public:
    explicit GatherGrid(const Image<DiffuseSurface>& surfaces) : surfaces_(surfaces) {
        const double pixels = static_cast<double>(surfaces.size());
        int spacing = min_coarse_spacing;
        while (2.0 * spacing * spacing < pixels / coarse_nodes) spacing *= 2;
        while (levels_ < max_levels && spacing > 1 << (levels_ - 1)) ++levels_;
        finest_ = spacing >> (levels_ - 1);
        nodes_ = Image<Node>((surfaces.width - 1) / finest_ + 1, (surfaces.height - 1) / finest_ + 1);
    }

    struct Node {
        Rgb irradiance{0.0f};
        bool gathered = false;
    };

    int levels() const { return levels_; }
    int spacing(int level) const { return finest_ << (levels_ - 1 - level); }
    /// The node of a pixel that is one at the level.
    Node& node(int x, int y) { return nodes_(x / finest_, y / finest_); }
    const Image<Node>& nodes() const { return nodes_; }

    /// Irradiance and the confidence in it, [0,1]: from the coarsest level whose nodes lie on the pixel's own surface;
    /// where two levels meet, from both.
    struct Interpolated {
        Rgb irradiance{0.0f};  ///< times confidence
        float confidence = 0.0f;
    };
    /// @param levels  how many of the levels to ask, from the coarsest
    Interpolated interpolate(int x, int y, int levels) const {
        Interpolated out;
        for (int level = 0; level < levels && out.confidence < done; ++level) {
            const Interpolated here = interpolate_level(x, y, spacing(level));
            if (here.confidence <= 0.0f) continue;
            const float share = (1.0f - out.confidence) * smooth_step(0.1f, 0.5f, here.confidence);
            out.irradiance += here.irradiance * (share / here.confidence);
            out.confidence += share;
        }
        return out;
    }

  private:
    /// Quadratic B-spline over 3x3 nodes, weighted by how far they share the pixel's surface. Confidence is the share
    /// of the spline's weight that remains.
    Interpolated interpolate_level(int x, int y, int spacing) const {
        const DiffuseSurface& here = surfaces_(x, y);
        const Spline across = make_spline(x, spacing), along = make_spline(y, spacing);
        // Farther from the plane than the nodes are apart, light may be another.
        const float inverse_reach = 1.0f / (static_cast<float>(spacing) * here.footprint);
        Interpolated sum;
        float whole = 0.0f;
        for (int j = 0; j < 3; ++j) {
            const int node_y = (along.first + j) * spacing;
            if (node_y < 0 || node_y >= surfaces_.height) continue;
            for (int i = 0; i < 3; ++i) {
                const int node_x = (across.first + i) * spacing;
                if (node_x < 0 || node_x >= surfaces_.width) continue;
                const float weight = across.weights[i] * along.weights[j];
                whole += weight;
                const Node& node = nodes_(node_x / finest_, node_y / finest_);
                if (!node.gathered) continue;
                const DiffuseSurface& there = surfaces_(node_x, node_y);
                const glm::vec3 between = there.position - here.position;
                const float off_plane =
                    std::max(std::abs(glm::dot(between, here.normal)), std::abs(glm::dot(between, there.normal)));
                const float near = std::max(0.0f, 1.0f - off_plane * inverse_reach);
                const float alike = std::max(0.0f, 2.0f * glm::dot(here.normal, there.normal) - 1.0f);
                const float shared = weight * near * near * alike * alike;
                sum.irradiance += node.irradiance * shared;
                sum.confidence += shared;
            }
        }
        sum.irradiance /= whole;
        sum.confidence /= whole;
        return sum;
    }

    struct Spline {
        int first = 0;  ///< node
        std::array<float, 3> weights{};
    };
    static Spline make_spline(int pixel, int spacing) {
        const int nearest = (pixel + spacing / 2) / spacing;
        const float t = static_cast<float>(pixel - nearest * spacing) / static_cast<float>(spacing);
        return {nearest - 1, {0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t, 0.5f * (0.5f + t) * (0.5f + t)}};
    }

    const Image<DiffuseSurface>& surfaces_;
    int levels_ = 1, finest_ = 1;
    Image<Node> nodes_;
};

/// The level's nodes at which coarser levels have nothing reliable to interpolate.
std::vector<glm::ivec2> list_missing(GatherGrid& grid, const Image<DiffuseSurface>& surfaces, int level) {
    constexpr float reliable = 0.5f;
    std::vector<glm::ivec2> missing;
    const int spacing = grid.spacing(level);
    for (int y = 0; y < surfaces.height; y += spacing) {
        for (int x = 0; x < surfaces.width; x += spacing) {
            if (!(surfaces(x, y).footprint > 0.0f) || grid.node(x, y).gathered) continue;
            if (level == 0 || grid.interpolate(x, y, level).confidence < reliable) missing.push_back({x, y});
        }
    }
    return missing;
}

void gather_nodes(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                  const std::vector<glm::ivec2>& pixels, GatherGrid& grid, RayCounts& counts) {
    const HemisphereStrata strata = choose_strata(gather_rays);
    std::mutex counts_mutex;
    parallel_for(pixels.size(), 4, [&](std::size_t begin, std::size_t end) {
        thread_local GatherScratch scratch;
        RayTask task(context.rays);
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec2& p = pixels[i];
            const PixelSurface surface = make_pixel_surface(context.shading, view, centers, p.x, p.y);
            const Rgb irradiance =
                gather_irradiance(context, task, surface.point, strata, RandomKey{}, scratch).irradiance;
            if (is_finite(irradiance)) grid.node(p.x, p.y) = {irradiance, true};
        }
        const std::lock_guard lock(counts_mutex);
        counts += task.counts;
    });
}

Rgb mean_irradiance(const GatherGrid& grid) {
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (const GatherGrid::Node& node : grid.nodes().pixels) {
        if (!node.gathered) continue;
        sum += glm::dvec3(node.irradiance);
        ++count;
    }
    return count == 0 ? Rgb(0.0f) : Rgb(sum / static_cast<double>(count));
}

}  // namespace

DiffuseSurface make_diffuse_surface(const PixelSurface& surface) {
    if (!surface.material.has_diffuse()) return {};
    const float cos_view = std::max(glm::dot(surface.point.normal, surface.view), 0.0f);
    return {surface.point.position, surface.point.normal, surface.footprint,
            diffuse_radiance(surface.material, cos_view, Rgb(1.0f))};
}

Image<Rgb> estimate_indirect_light(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                   const Image<DiffuseSurface>& surfaces, RayCounts& counts) {
    Image<Rgb> light(surfaces.width, surfaces.height);
    GatherGrid grid(surfaces);
    for (int level = 0; level < grid.levels(); ++level) {
        gather_nodes(context, view, centers, list_missing(grid, surfaces, level), grid, counts);
    }
    const Rgb mean = mean_irradiance(grid);
    parallel_rows(surfaces.height, 4, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < surfaces.width; ++x) {
                const DiffuseSurface& surface = surfaces(x, y);
                if (!(surface.footprint > 0.0f)) continue;
                const GatherGrid::Interpolated found = grid.interpolate(x, y, grid.levels());
                const Rgb irradiance = found.irradiance + mean * (1.0f - found.confidence);
                light(x, y) = surface.reflected * irradiance;
            }
        }
    });
    return light;
}

}  // namespace aleph
