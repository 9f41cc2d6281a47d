#pragma once
// Holes in surfaces: materials with an alpha mask let rays pass, blended ones let a share of the rays pass (Blend in
// ray_scene.h says which).

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// The alpha of a texture, filtered as the reference says. A copy: the scene's images need not stay.
struct AlphaTexture {
    TextureRef reference;
    Image<float> alpha;  ///< empty: 1 everywhere

    /// At texture coordinates as the mesh has them, v downwards; KHR_texture_transform applies. Coordinates that
    /// are not finite then count as 0.
    float sample(const glm::vec2& uv) const;
};

AlphaTexture make_alpha_texture(const Scene& scene, const TextureRef& reference);

/// The material and the texture coordinates that the holes of a mesh are found from.
struct AlphaCutout {
    int material = no_index;
    float cutoff = 0.5f;
    bool blended = false;
    bool plain = false;  ///< blended, and glass at no time: 1 - alpha is all that it lets pass
    AlphaTexture texture;
    std::vector<glm::uvec3> triangles;
    std::vector<glm::vec2> uv;        ///< per vertex, of the texture's set; may be empty
    std::vector<float> vertex_alpha;  ///< may be empty

    /// Alpha at barycentrics u, v of a triangle.
    /// @param material_alpha  MaterialValues::alpha now
    float alpha_at(float material_alpha, unsigned primitive, float u, float v) const;
};

/// False for meshes without holes: those cost nothing. So are masked and blended ones whose alpha is 1 everywhere.
bool has_cutout(const Scene& scene, const Mesh& mesh);

/// True where a mesh that some node carries has a blended material, and an alpha that can differ from 1.
bool has_blended(const Scene& scene);

/// For a mesh that has_cutout.
AlphaCutout make_alpha_cutout(const Scene& scene, const Mesh& mesh);

}  // namespace aleph
