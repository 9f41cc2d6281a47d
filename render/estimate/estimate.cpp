#include "render/estimate/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "render/cache/gather.h"
#include "render/estimate/sight_line.h"

namespace aleph {

namespace {

constexpr int gather_rays = 48;
constexpr double coarse_nodes = 300.0;  // about as many pixels are gathered first
constexpr int min_coarse_spacing = 8;   // pixels; closer, the noise of gathers would be finer than light itself
constexpr int max_levels = 4;           // each halves the spacing
constexpr float done = 0.999f;          // confidence at which no finer level is asked

/// Weights of three nodes along one axis.
struct Spline {
    int first = 0;  ///< node
    std::array<float, 3> weights{};
};

Spline make_spline(double pixel, int spacing, NodeSpline kind) {
    const double nearest = std::floor((pixel + 0.5 * spacing) / spacing);
    const float t = static_cast<float>(pixel - nearest * spacing) / static_cast<float>(spacing);
    const int first = static_cast<int>(nearest) - 1;
    if (kind == NodeSpline::linear) return {first, {std::max(-t, 0.0f), 1.0f - std::abs(t), std::max(t, 0.0f)}};
    return {first, {0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t, 0.5f * (0.5f + t) * (0.5f + t)}};
}

/// A weight, less where two places do not share a surface: by their normals, and by their distance from each other's
/// plane. Farther from the plane than the nodes are apart, light may be another.
float share(float weight, const DiffuseSurface& here, const DiffuseSurface& there, float inverse_reach) {
    const glm::vec3 between = there.position - here.position;
    const float off_plane =
        std::max(std::abs(glm::dot(between, here.normal)), std::abs(glm::dot(between, there.normal)));
    const float near = std::max(0.0f, 1.0f - off_plane * inverse_reach);
    const float alike = std::max(0.0f, 2.0f * glm::dot(here.normal, there.normal) - 1.0f);
    return weight * near * near * alike * alike;
}

/// Points per light: fewer if there are many lights, so that the estimate stays quick. A single point of a window shows
/// all of its light or none, whatever share of it glazing bars hide. Many points of a bulb face away.
int points_per_light(const LightSet& lights) {
    constexpr int most_points = 16, most_per_light = 4;
    const bool has_sides =
        std::ranges::any_of(lights.emitters, [](const Emitter& e) { return !e.shape->sides.empty(); });
    return std::clamp(most_points / std::max(1, lights.count()), 1, has_sides ? most_points : most_per_light);
}

}  // namespace

EstimateNodes::EstimateNodes(int width, int height) : width_(width), height_(height) {
    const double pixels = static_cast<double>(width) * height;
    int spacing = min_coarse_spacing;
    while (2.0 * spacing * spacing < pixels / coarse_nodes) spacing *= 2;
    while (levels_ < max_levels && spacing > 1 << (levels_ - 1)) ++levels_;
    finest_ = spacing >> (levels_ - 1);
    nodes_ = Image<Node>((width - 1) / finest_ + 1, (height - 1) / finest_ + 1);
}

EstimateNodes::Interpolated EstimateNodes::interpolate(const DiffuseSurface& here, const glm::dvec2& pixel, int levels,
                                                       NodeSpline kind) const {
    Interpolated out;
    for (int level = 0; level < levels && out.confidence < done; ++level) {
        const Interpolated found = interpolate_level(here, pixel, spacing(level), kind);
        if (found.confidence <= 0.0f) continue;
        const float part = (1.0f - out.confidence) * glm::smoothstep(0.1f, 0.5f, found.confidence);
        out.irradiance += found.irradiance * (part / found.confidence);
        out.confidence += part;
    }
    return out;
}

/// Over 3x3 nodes, weighted by how far they share the surface. Confidence is the share of the spline's weight that
/// remains.
EstimateNodes::Interpolated EstimateNodes::interpolate_level(const DiffuseSurface& here, const glm::dvec2& pixel,
                                                             int spacing, NodeSpline kind) const {
    const Spline across = make_spline(pixel.x, spacing, kind), along = make_spline(pixel.y, spacing, kind);
    const float inverse_reach = 1.0f / (static_cast<float>(spacing) * here.footprint);
    Interpolated sum;
    float whole = 0.0f;
    for (int j = 0; j < 3; ++j) {
        const int y = (along.first + j) * spacing;
        if (y < 0 || y >= height_) continue;
        for (int i = 0; i < 3; ++i) {
            const int x = (across.first + i) * spacing;
            if (x < 0 || x >= width_) continue;
            const float weight = across.weights[i] * along.weights[j];
            whole += weight;
            const Node& there = nodes_(x / finest_, y / finest_);
            if (!there.known) continue;
            const float shared = share(weight, here, there.surface, inverse_reach);
            sum.irradiance += there.irradiance * shared;
            sum.confidence += shared;
        }
    }
    if (!(whole > 0.0f)) return {};
    sum.irradiance /= whole;
    sum.confidence /= whole;
    return sum;
}

namespace {

/// The level's nodes at which coarser levels have nothing reliable to interpolate.
std::vector<glm::ivec2> list_missing(EstimateNodes& nodes, int level) {
    constexpr float reliable = 0.5f;
    std::vector<glm::ivec2> missing;
    const int spacing = nodes.spacing(level);
    for (int y = 0; y < nodes.height(); y += spacing) {
        for (int x = 0; x < nodes.width(); x += spacing) {
            const EstimateNodes::Node& node = nodes.node(x, y);
            if (!(node.surface.footprint > 0.0f) || node.known) continue;
            const auto found = nodes.interpolate(node.surface, {x, y}, level, NodeSpline::quadratic);
            if (found.confidence < reliable) missing.push_back({x, y});
        }
    }
    return missing;
}

/// The surface with a Lambert layer that a line of sight shows most of.
std::optional<PixelSurface> find_shown_surface(SightLine line, RayCounts& counts) {
    std::optional<PixelSurface> shown;
    float most = 0.0f;
    do {
        while (line.advance(counts)) {
            const float share = line.surface().material.has_diffuse() ? largest_channel(line.share()) : 0.0f;
            if (!(share > most)) continue;
            most = share;
            shown = line.surface();
        }
    } while (line.reflect());
    return shown;
}

/// The surfaces at all nodes.
void find_node_surfaces(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                        EstimateNodes& nodes, RayCounts& counts) {
    const int spacing = nodes.spacing(nodes.levels() - 1);
    const auto find_row = [&](int row, RayTask& task) {
        const int y = row * spacing;
        for (int x = 0; x < nodes.width(); x += spacing) {
            const SightStart start = start_at_center(view, centers, {x, y});
            const auto shown = find_shown_surface({context, task.tracer, start}, task.counts);
            if (shown) nodes.node(x, y).surface = make_diffuse_surface(*shown);
        }
    };
    cast_parallel(nodes.nodes().height, 2, context.rays, counts, find_row, Blend::whole);
}

Rgb mean_irradiance(const EstimateNodes& nodes) {
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (const EstimateNodes::Node& node : nodes.nodes().pixels) {
        if (!node.known) continue;
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

EstimateNodes gather_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              const CarriedEstimate* carried, RayCounts& counts) {
    EstimateNodes nodes(view.width, view.height);
    find_node_surfaces(context, view, centers, nodes, counts);
    const HemisphereStrata strata = choose_strata(gather_rays);
    for (int level = 0; level < nodes.levels(); ++level) {
        const std::vector<glm::ivec2> pixels = list_missing(nodes, level);
        cast_parallel(pixels.size(), 4, context.rays, counts, [&](int i, RayTask& task) {
            thread_local GatherScratch scratch;
            const glm::ivec2& p = pixels[i];
            Tracer whole(context.rays, Blend::whole);
            const PixelSurface surface =
                *find_shown_surface({context, whole, start_at_center(view, centers, p)}, task.counts);
            EstimateNodes::Node& node = nodes.node(p.x, p.y);
            const std::optional<Rgb> found = carried != nullptr ? carried->find(surface) : std::nullopt;
            node.irradiance =
                found ? *found : gather_irradiance(context, task, surface.point, {strata}, scratch).irradiance;
            node.known = is_finite(node.irradiance);
        });
    }
    return nodes;
}

NodeIrradiance::NodeIrradiance(const EstimateNodes& nodes) : nodes_(nodes), mean_(mean_irradiance(nodes)) {}

Rgb NodeIrradiance::at(const DiffuseSurface& surface, const glm::dvec2& pixel) const {
    const EstimateNodes::Interpolated found =
        nodes_.interpolate(surface, pixel, nodes_.levels(), NodeSpline::quadratic);
    return found.irradiance + mean_ * (1.0f - found.confidence);
}

Rgb estimate_radiance(const SightLine& line, RayTask& task, EstimateKind kind) {
    const LightingContext& context = line.lighting();
    const SurfaceMaterial& material = line.surface().material;
    if (kind == EstimateKind::direct) {
        const int points = points_per_light(context.lights);
        return line.emission() + estimate_direct_light(context, task, line.surface(), points, line.followed());
    }
    return material.emission + material.diffuse + (line.followed() == LobeShares{} ? material.gloss.f0 : Rgb(0.0f));
}

Rgb estimate_surroundings(const SightLine& line, EstimateKind kind) {
    if (kind == EstimateKind::flat) return Rgb(1.0f);
    return environment_radiance(line.lighting().shading, line.direction()) * line.weight_beyond();
}

namespace {

/// The light that a line of sight meets, times exposure.
struct EstimatedLight {
    RayTask& task;
    EstimateKind kind;
    const NodeIrradiance* indirect;  ///< null: none
    float exposure;

    Rgb beyond(const SightLine& line) const { return estimate_surroundings(line, kind) * exposure; }

    Rgb of(const SightLine& line) const {
        const PixelSurface& surface = line.surface();
        const Rgb radiance = estimate_radiance(line, task, kind) * exposure;
        if (indirect == nullptr) return radiance;
        const DiffuseSurface diffuse = make_diffuse_surface(surface);
        if (!(diffuse.footprint > 0.0f)) return radiance;
        return radiance + diffuse.reflected * indirect->at(diffuse, {surface.x, surface.y}) * exposure;
    }
};

}  // namespace

Image<Rgb> compute_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                            const EstimateOptions& options, RayCounts& counts) {
    const EstimateKind kind = options.kind;
    Image<Rgb> estimate(view.width, view.height);
    std::optional<NodeIrradiance> indirect;
    if (options.indirect != nullptr && kind == EstimateKind::direct) indirect.emplace(*options.indirect);
    const auto exposure = static_cast<float>(options.exposure);
    const auto estimate_row = [&](int y, RayTask& task) {
        Tracer whole(context.rays, Blend::whole);
        const EstimatedLight light{task, kind, indirect ? &*indirect : nullptr, exposure};
        for (int x = 0; x < view.width; ++x) {
            const SightStart start = start_at_center(view, centers, {x, y});
            estimate(x, y) = add_along_lines(light, context, whole, start, task.counts);
        }
    };
    cast_parallel(view.height, 4, context.rays, counts, estimate_row, Blend::cutout);  // without noise
    return estimate;
}

std::optional<double> compute_exposure(const Image<Rgb>& estimate) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Rgb& pixel : estimate.pixels) {
        const double y = luminance(pixel);
        if (!(y > 0.0) || !std::isfinite(y)) continue;
        sum += std::log(y);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return 0.18 / std::exp(sum / static_cast<double>(count));
}

}  // namespace aleph
