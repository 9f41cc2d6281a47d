#pragma once
// Emissive instances as lights, and the places on them that are sampled.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "engine/rays/ray_scene.h"
#include "render/surface/shading_scene.h"

namespace aleph {

struct RayFootprint;

/// The triangles of a mesh, each divided into n x n cells of the same shape, about a texel large. What they emit does
/// not depend on the pose, so it is kept.
struct CellTexels {
    struct Part {
        int divisions = 1;  ///< n
        std::size_t first = 0;
        std::size_t size() const { return static_cast<std::size_t>(divisions) * static_cast<std::size_t>(divisions); }
    };
    const Mesh* mesh = nullptr;
    int material = no_index;
    float alpha = 1.0f;
    std::size_t most = 0;     ///< of cells, about; at least one for each triangle
    std::vector<Part> parts;  ///< per primitive
    std::vector<Rgb> texels;  ///< per cell: the mean of its texture, times what alpha leaves of it
};
using KeptTexels = std::vector<std::shared_ptr<const CellTexels>>;

/// Cells of a lamp whose emission is uneven, sampled in proportion to their emission.
struct EmissionCells {
    std::shared_ptr<const CellTexels> texels;  ///< null: places are sampled by area
    std::vector<float> ends;                   ///< per cell: the share of its triangle's samples up to and including it
    std::vector<float> spreads;                ///< per cell, m2: its area over its share of all samples

    bool empty() const { return texels == nullptr; }
};

/// What a shape is made from. Shapes are equal where these are.
struct EmitterOrigin {
    const Mesh* mesh = nullptr;  ///< null: deforming, never equal
    bool double_sided = false;
    /// Of lamps with a texture or alpha; for others, as here.
    int material = no_index;
    Rgb emission{0.0f};
    float alpha = 1.0f;
    std::size_t most_cells = 0;  ///< CellTexels::most
    /// Of lamps whose transform is more than a rotation, an even scale and a translation; for others, as here.
    glm::mat3 linear{1.0f}, normals{1.0f};

    bool operator==(const EmitterOrigin& other) const = default;
};

/// The triangles of a lamp, and what follows from them alone. Lamps of one mesh share them.
struct EmitterShape {
    struct Triangle {
        glm::vec3 corner, edge1, edge2;  ///< m
        glm::vec3 normal;                ///< unit, on the side that emits
        int primitive;
    };
    /// Triangles that face about the same way.
    struct Side {
        glm::vec4 low, high;             ///< of normals, and of the planes' distances along them from `center`, m
        float begin = 0.0f, end = 0.0f;  ///< of `cumulative`
    };
    EmitterOrigin origin;
    float area = 0.0f;               ///< m2, of all triangles
    float cos_cone = 1.0f;           ///< the least between the normals of the first triangle and of another
    float mean_of_brightest = 1.0f;  ///< with cells, the mean radiance as a share of `brightest`; above 0
    glm::vec3 center{0.0f};          ///< m, of a sphere around all triangles
    float radius = 0.0f;             ///< m, of that sphere
    std::vector<Triangle> triangles;
    std::vector<float>
        cumulative;           ///< share of the samples up to and including each triangle: of the area, or by cells
    std::vector<Side> sides;  ///< in the order of the triangles; empty: all may face any point
    EmissionCells cells;
};

/// One emissive instance: all its triangles together are one light.
struct Emitter {
    using Triangle = EmitterShape::Triangle;
    using Side = EmitterShape::Side;

    int instance = no_index;
    bool double_sided = false;
    bool textured = false;
    bool has_alpha = false;  ///< some rays may pass it: a mask, or blended
    Rgb radiance{0.0f};      ///< without texture
    Rgb brightest{0.0f};     ///< no less than the radiance anywhere: where its texture is brightest, or white
    std::shared_ptr<const EmitterShape> shape;
    glm::mat3 turn{1.0f};  ///< of the shape: a rotation times `scale`
    float scale = 1.0f;
    glm::vec3 translation{0.0f};  ///< m, of the shape, relative to the anchor
    float area = 0.0f;            ///< m2, of all triangles
    glm::vec3 center{0.0f};       ///< m, relative to the anchor: of a sphere around all triangles
    float radius = 0.0f;          ///< m, of that sphere

    std::size_t size() const { return shape->triangles.size(); }
    /// m, relative to the anchor.
    Triangle triangle(std::size_t i) const {
        const Triangle& t = shape->triangles[i];
        return {turn * t.corner + translation, turn * t.edge1, turn * t.edge2, turn * t.normal / scale, t.primitive};
    }
};

/// A triangle of an instance on the side of its winding. The normal is not finite if the triangle has no area.
Emitter::Triangle place_triangle(const PosedInstance& instance, int primitive);
/// m2.
double area_of(const Emitter::Triangle& triangle);
/// Sets area, shares by area, cone and sphere from the triangles.
void measure(EmitterShape& shape);
/// Gives an emitter its shape, and what follows from that and from its place.
void set_shape(std::shared_ptr<const EmitterShape> shape, Emitter& emitter);

/// Looks at the emission of a lamp with a texture or alpha. Where it is uneven, sets its mean, the cells and the shares
/// of the triangles.
/// @param emitter  that gets the shape
/// @param kept     of this scene at any time; new ones are added
void divide_by_emission(const ShadingScene& shading, const Emitter& emitter, KeptTexels& kept, EmitterShape& shape);

/// Radiance that rays find at a point of a lamp, in the mean over those that pass it.
Rgb emitted_radiance(const ShadingScene& shading, const Emitter& emitter, const SurfacePoint& point,
                     const RayFootprint& footprint);

/// A place on one of the triangles.
struct EmitterPlace {
    std::size_t triangle = 0;  ///< into EmitterShape::triangles
    glm::vec2 b{0.0f};         ///< barycentric
    float spread = 0.0f;       ///< m2: 1 / density per area of places sampled on the whole emitter
};

/// A place of a triangle that was chosen by EmitterShape::cumulative: uniform in its area, or by cells. u in [0,1)^2.
EmitterPlace sample_place(const Emitter& emitter, std::size_t triangle, glm::vec2 u);

/// EmitterPlace::spread of a place of a triangle, b barycentric.
float spread_of(const Emitter& emitter, int primitive, const glm::vec2& b);

}  // namespace aleph
