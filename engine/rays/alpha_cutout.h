#pragma once
// Where a surface is not there: materials with an alpha mask let rays pass. Blended ones are taken as a mask at .5.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A texture's alpha, read between texels as the reference says; kept apart from the scene, whose images may go.
struct AlphaTexture {
    TextureRef reference;
    Image<float> alpha;  ///< empty: 1 everywhere

    /// At texture coordinates as the mesh has them, v downwards; KHR_texture_transform applies. What is not
    /// finite then counts as 0.
    float sample(const glm::vec2& uv) const;
};

AlphaTexture make_alpha_texture(const Scene& scene, const TextureRef& reference);

/// What a mesh with such a material needs to tell holes from surface.
struct AlphaCutout {
    int material = no_index;
    float cutoff = 0.5f;
    AlphaTexture texture;
    std::vector<glm::uvec3> triangles;
    std::vector<glm::vec2> uv;        ///< per vertex, of the texture's set; may be empty
    std::vector<float> vertex_alpha;  ///< may be empty

    /// Whether a ray passes at barycentrics u, v of a triangle.
    /// @param material_alpha  MaterialValues::alpha now
    bool is_hole(float material_alpha, unsigned primitive, float u, float v) const;
};

/// False for materials that rays always meet: those cost nothing.
bool has_cutout(const Scene& scene, const Mesh& mesh);

/// Of a mesh that has_cutout.
AlphaCutout make_alpha_cutout(const Scene& scene, const Mesh& mesh);

}  // namespace aleph
