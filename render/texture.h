#pragma once
// Texture look-up filtered by footprint: bilinear where the picture is magnified, else probes into a pyramid of coarser
// levels along the longer axis of what the ray covers.

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

enum class TextureSpace {
    linear,
    srgb,  ///< colour channels of 8-bit images are decoded; float images are linear already
};

/// One picture as one use reads it: linear values. Level 0 stays in the scene's image, decoded texel by texel; each
/// coarser one is half as large, rounded down, to 1 x 1. All cover uv in [0,1]^2 and have the same mean.
struct Texture {
    const SceneImage* image = nullptr;  ///< must outlive this
    TextureSpace space = TextureSpace::linear;
    int width = 0, height = 0;             ///< texels of level 0
    std::vector<Image<glm::vec4>> coarse;  ///< level 1 and up
};

/// A material's reference to a texture, ready for look-ups.
struct TextureUse {
    int texture = no_index;  ///< into TextureSet::textures; no_index reads as white
    int uv_set = 0;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;
    bool transformed = false;  ///< uv' = offset + matrix uv
    glm::mat2 matrix{1.0f};
    glm::vec2 offset{0.0f};
};

struct MaterialTextures {
    TextureUse base_color, metallic_roughness, emission, specular, specular_color;
    bool any = false;
};

/// Every texture of a scene. Made once (make_texture_set); look-ups only read it.
struct TextureSet {
    std::vector<Texture> textures;            ///< one for each image and space in use
    std::vector<MaterialTextures> materials;  ///< as Scene::materials, and one without textures at the end
};

/// Builds the pyramids, in parallel. Keeps pointers to the scene's images: the scene must outlive the set.
TextureSet make_texture_set(const Scene& scene);

Texture make_texture(const SceneImage& image, TextureSpace space);
/// @param texture  into TextureSet::textures
TextureUse make_texture_use(const TextureRef& reference, int texture);

/// What a look-up stands for, in uv before the reference's own transform.
struct UvFootprint {
    /// How uv changes from this ray to its neighbours: the footprint is the parallelogram that they span.
    glm::vec2 dx{0.0f}, dy{0.0f};
    /// Only the parallelogram's area counts: one probe, for wide cones that need not be sharp.
    bool round = false;
};

/// The texture at uv (v downwards from the image's top row), averaged over the footprint; the plain bilinear value (or
/// the nearest texel, where the reference asks for that) if the footprint is smaller than a texel.
/// A uv that is not finite, or beyond 1e6, reads as (0, 0); a footprint that is not finite as the mean of the picture.
glm::vec4 sample_texture(const TextureSet& set, const TextureUse& use, const glm::vec2& uv,
                         const UvFootprint& footprint);

}  // namespace aleph
