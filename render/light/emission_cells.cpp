// Lamps whose emission is uneven over their area: screens, signs, strings of small lights on one texture.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/base/sampling.h"
#include "render/light/emitter.h"
#include "render/surface/environment_map.h"
#include "render/surface/surface_material.h"

namespace aleph {

namespace {

/// Where the emission's square of the mean is a larger share of its mean square, sampling by area is good enough.
constexpr double even_enough = 0.4;

/// Share of the samples that go by area: the emission of a cell is known from a few look-ups.
constexpr double share_by_area = 0.125;

/// The mean of a light that is not black, at least, as a share of `brightest`: look-ups may all miss what shines.
constexpr double least_mean = 1.0 / 4096.0;

constexpr double most_divisions = 4096.0;

/// A point of a triangle for texture look-ups, in a plane of its own where the edges are unit axes: it is the same in
/// all poses.
SurfacePoint make_flat_point(const Mesh& mesh, int material, const glm::uvec3& t, const glm::vec2& b) {
    SurfacePoint point;
    point.material = material;
    point.edges[0] = {1.0f, 0.0f, 0.0f};
    point.edges[1] = {0.0f, 1.0f, 0.0f};
    for (int set = 0; set < 2; ++set) {
        const std::vector<glm::vec2>& uv = mesh.uv[set];
        if (uv.empty()) continue;
        point.uv_edges[set][0] = uv[t.y] - uv[t.x];
        point.uv_edges[set][1] = uv[t.z] - uv[t.x];
        point.uv[set] = uv[t.x] + point.uv_edges[set][0] * b.x + point.uv_edges[set][1] * b.y;
    }
    const std::vector<glm::vec4>& colors = mesh.colors;
    if (!colors.empty()) point.color = colors[t.x] * (1.0f - b.x - b.y) + colors[t.y] * b.x + colors[t.z] * b.y;
    return point;
}

/// Half texels along the second of the edges by length: no texel border crosses cells of a rectangle, and few of a
/// cell change much within.
double count_half_texels(const TextureSet& set, const TextureUse& use, const SurfacePoint& point) {
    if (use.texture == no_index) return 1.0;
    const Texture& texture = set.textures[use.texture];
    const glm::mat2 to_image = use.transformed ? use.matrix : glm::mat2(1.0f);
    const glm::vec2 size(texture.width, texture.height);
    const glm::vec2 e1 = to_image * point.uv_edges[use.uv_set][0] * size;
    const glm::vec2 e2 = to_image * point.uv_edges[use.uv_set][1] * size;
    std::array<float, 3> edges{glm::length(e1), glm::length(e2), glm::length(e2 - e1)};
    std::ranges::sort(edges);
    const double texels = 2.0 * double{edges[1]};
    return texels < most_divisions ? std::max(texels, 1.0) : std::isfinite(texels) ? most_divisions : 1.0;
}

/// @return number of cells
std::size_t divide_triangles(const ShadingScene& shading, CellTexels& cells) {
    const MaterialTextures& uses = shading.textures->materials[cells.material];
    std::vector<double> texels;
    double sum = 0.0;
    for (const glm::uvec3& t : cells.mesh->triangles) {
        const SurfacePoint point = make_flat_point(*cells.mesh, cells.material, t, {});
        texels.push_back(std::max(count_half_texels(*shading.textures, uses[TextureSlot::emission], point),
                                  count_half_texels(*shading.textures, uses[TextureSlot::base_color], point)));
        sum += texels.back() * texels.back();
    }
    const double scale = std::min(1.0, std::sqrt(static_cast<double>(cells.most) / sum));
    std::size_t count = 0;
    for (const double n : texels) {
        cells.parts.push_back({std::max(1, static_cast<int>(std::round(n * scale))), count});
        count += cells.parts.back().size();
    }
    return count;
}

/// Cells of a triangle are in rows along its first edge. Above each but the last of a row stands one upside down.
struct Cell {
    int column = 0, row = 0;
    bool turned = false;

    std::size_t index(int divisions) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(2 * divisions - row) +
               static_cast<std::size_t>(2 * column + (turned ? 1 : 0));
    }
    /// @param within  barycentric, of the cell
    glm::vec2 place(int divisions, const glm::vec2& within) const {
        const glm::vec2 from = turned ? 1.0f - within : within;
        return (glm::vec2(column, row) + from) / static_cast<float>(divisions);
    }
};

Cell cell_at(std::size_t index, int divisions) {
    const auto n = static_cast<std::size_t>(divisions);
    // The rows from one on have (n - row)^2 cells.
    const auto left = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n * n - index))));
    Cell cell{.row = static_cast<int>(n - left)};
    const auto along = static_cast<int>(index - cell.index(divisions));
    cell.column = along / 2;
    cell.turned = along % 2 == 1;
    return cell;
}

Cell find_cell(const glm::vec2& b, int divisions) {
    const glm::vec2 at = glm::max(b, glm::vec2(0.0f)) * static_cast<float>(divisions);
    Cell cell;
    cell.row = std::min(static_cast<int>(at.y), divisions - 1);
    cell.column = std::min(static_cast<int>(at.x), divisions - 1 - cell.row);
    const glm::vec2 within = at - glm::vec2(cell.column, cell.row);
    cell.turned = within.x + within.y > 1.0f && cell.column + cell.row < divisions - 1;
    return cell;
}

/// The mean of a cell's quarters.
Rgb look_at_cell(const ShadingScene& shading, const CellTexels& cells, std::size_t primitive, const Cell& cell) {
    constexpr float near = 1.0f / 6.0f, far = 4.0f / 6.0f;
    const int n = cells.parts[primitive].divisions;
    const RayFootprint footprint{.width = std::sqrt(0.125f) / static_cast<float>(n)};
    Rgb sum(0.0f);
    for (const glm::vec2& within : {glm::vec2(1.0f / 3.0f), {near, near}, {far, near}, {near, far}}) {
        const SurfacePoint point =
            make_flat_point(*cells.mesh, cells.material, cells.mesh->triangles[primitive], cell.place(n, within));
        sum += 0.25f * emission_texel(shading, point, footprint) * surface_coverage(shading, point, footprint);
    }
    return sum;
}

std::shared_ptr<const CellTexels> find_texels(const ShadingScene& shading, const Emitter& emitter, std::size_t most,
                                              KeptTexels& kept) {
    const PosedInstance& instance = shading.instances[emitter.instance];
    const float alpha = emitter.has_alpha ? shading.materials[instance.material].values.alpha : 1.0f;
    const auto found = std::ranges::find_if(kept, [&](const auto& texels) {
        return texels->mesh == instance.mesh && texels->material == instance.material && texels->alpha == alpha &&
               texels->most == most;
    });
    if (found != kept.end()) return *found;
    CellTexels cells{instance.mesh, instance.material, alpha, most, {}, {}};
    cells.texels.reserve(divide_triangles(shading, cells));
    for (std::size_t primitive = 0; primitive < cells.parts.size(); ++primitive) {
        const CellTexels::Part& part = cells.parts[primitive];
        for (std::size_t k = 0; k < part.size(); ++k)
            cells.texels.push_back(look_at_cell(shading, cells, primitive, cell_at(k, part.divisions)));
    }
    // One for each lamp is in use; others are of another time.
    if (kept.size() > 2 * shading.emitting.size()) kept.erase(kept.begin());
    return kept.emplace_back(std::make_shared<const CellTexels>(std::move(cells)));
}

/// Sums over all cells of a lamp.
struct Emission {
    double power = 0.0;    ///< integral of luminance over the area
    double squares = 0.0;  ///< of its square
};

}  // namespace

void divide_by_emission(const ShadingScene& shading, const Emitter& emitter, KeptTexels& kept, EmitterShape& shape) {
    EmissionCells found{
        .texels = find_texels(shading, emitter, shape.origin.most_cells, kept), .ends = {}, .spreads = {}};
    const std::vector<Rgb>& texels = found.texels->texels;
    const auto part_of = [&](const Emitter::Triangle& t) { return found.texels->parts[t.primitive]; };
    const auto shining = [&](std::size_t cell) {
        return std::max(0.0, double{luminance(emitter.radiance * texels[cell])});
    };
    Emission all;
    for (const Emitter::Triangle& t : shape.triangles) {
        const CellTexels::Part part = part_of(t);
        const double area = area_of(t) / static_cast<double>(part.size());
        for (std::size_t k = part.first; k < part.first + part.size(); ++k) {
            const double emits = shining(k);
            all.power += area * emits;
            all.squares += area * emits * emits;
        }
    }
    const double brightest = luminance(emitter.brightest);
    if (!std::isfinite(all.squares) || !(brightest > 0.0)) return;
    // Where places are sampled by area, what shines more than the mean makes noise: such a light counts as all bright.
    if (!(all.power * all.power < even_enough * shape.area * all.squares)) return;
    shape.mean_of_brightest = static_cast<float>(std::clamp(all.power / (shape.area * brightest), least_mean, 1.0));
    found.ends.resize(texels.size());
    found.spreads.resize(texels.size());
    double end = 0.0;
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
        const CellTexels::Part part = part_of(shape.triangles[i]);
        const double area = area_of(shape.triangles[i]) / static_cast<double>(part.size());
        const double by_area = share_by_area * area / double{shape.area};
        double sum = 0.0;
        for (std::size_t k = part.first; k < part.first + part.size(); ++k) {
            const double share = (1.0 - share_by_area) * area * shining(k) / all.power + by_area;
            found.spreads[k] = static_cast<float>(area / share);
            found.ends[k] = static_cast<float>(sum += share);
        }
        for (float& cell_end : std::span(found.ends).subspan(part.first, part.size()))
            cell_end /= static_cast<float>(sum);
        shape.cumulative[i] = static_cast<float>(end += sum);
    }
    for (float& triangle_end : shape.cumulative) triangle_end /= static_cast<float>(end);
    shape.cells = std::move(found);
}

Rgb emitted_radiance(const ShadingScene& shading, const Emitter& emitter, const SurfacePoint& point,
                     const RayFootprint& footprint) {
    const Rgb radiance = emitter.textured ? surface_emission(shading, point, footprint) : emitter.radiance;
    return emitter.has_alpha ? radiance * surface_coverage(shading, point, footprint) : radiance;
}

EmitterPlace sample_place(const Emitter& emitter, std::size_t triangle, glm::vec2 u) {
    const EmissionCells& cells = emitter.shape->cells;
    if (cells.empty()) return {triangle, sample_triangle(u), emitter.area};
    const CellTexels::Part& part = cells.texels->parts[emitter.shape->triangles[triangle].primitive];
    const std::span<const float> ends = std::span(cells.ends).subspan(part.first, part.size());
    const auto cell = static_cast<std::size_t>(choose_part(ends, u.x));
    const glm::vec2 b = cell_at(cell, part.divisions).place(part.divisions, sample_triangle(u));
    return {triangle, b, cells.spreads[part.first + cell] * emitter.scale * emitter.scale};
}

float spread_of(const Emitter& emitter, int primitive, const glm::vec2& b) {
    const EmissionCells& cells = emitter.shape->cells;
    if (cells.empty()) return emitter.area;
    const CellTexels::Part& part = cells.texels->parts[primitive];
    return cells.spreads[part.first + find_cell(b, part.divisions).index(part.divisions)] * emitter.scale *
           emitter.scale;
}

}  // namespace aleph
