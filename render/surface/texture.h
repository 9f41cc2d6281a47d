#pragma once
// Texture look-up filtered by footprint, which is the part of a surface that one ray represents. Magnified textures are
// bilinear. Minified ones are averaged over probes into a pyramid of coarser levels, placed along the longer axis of
// the footprint.

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "engine/pose/camera_view.h"
#include "render/surface/environment_map.h"
#include "render/surface/shading_scene.h"

namespace aleph {

enum class TextureSpace {
    linear,
    srgb,  ///< colour channels of 8-bit images are decoded; float images are linear already
};

/// One image with its pyramid, in linear values. Level 0 is the scene's image, decoded at each look-up. Each coarser
/// level is half as large, rounded down, to 1 x 1. All cover uv in [0,1]^2 and have the same mean.
struct Texture {
    const SceneImage* image = nullptr;  ///< must outlive the texture, unless it is `masked`
    TextureSpace space = TextureSpace::linear;
    bool by_alpha = false;                    ///< colours count by their alpha; coarse levels hold colour times alpha
    int width = 0, height = 0;                ///< texels of level 0
    std::vector<Image<glm::vec4>> coarse{};   ///< level 1 and up
    glm::vec3 smallest{0.0f}, largest{0.0f};  ///< of each colour channel, over all texels
    std::shared_ptr<const SceneImage> masked{};  ///< an image with the alpha of another, which makes holes in it
};

/// A material's reference to a texture, ready for look-ups.
struct TextureUse {
    int texture = no_index;  ///< into TextureSet::textures; no_index is white
    int uv_set = 0;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;
    bool transformed = false;  ///< uv' = offset + matrix uv
    glm::mat2 matrix{1.0f};
    glm::vec2 offset{0.0f};
};

struct MaterialTextures : TextureSlots<TextureUse> {
    bool any = false;           ///< one of them is used
    bool maps_normals = false;  ///< a normal map is used
};

/// All textures of a scene. Made once (make_texture_set); look-ups only read it.
struct TextureSet {
    /// One for each image and space of materials that are ever shown, and one more for each image whose alpha makes
    /// holes in it.
    std::vector<Texture> textures;
    /// As Scene::materials, and one without textures at the end. A material that is hidden at all times has none.
    std::vector<MaterialTextures> materials;
    EnvironmentMap environment;  ///< empty: the scene has none
};

/// Builds the pyramids, in parallel. Keeps pointers to the scene's images: the scene must outlive the set.
TextureSet make_texture_set(const Scene& scene);

/// @param by_alpha  the image is the base colour of a surface that its alpha makes holes in: the colours of texels that
/// do not show do not count
Texture make_texture(const SceneImage& image, TextureSpace space, bool by_alpha = false);
TextureUse make_texture_use(const TextureRef& reference, int texture);

/// The area that a look-up averages over, in uv before the reference's own transform.
struct UvFootprint {
    /// Change of uv from this ray to its neighbours. The footprint is the parallelogram that they span.
    glm::vec2 dx{0.0f}, dy{0.0f};
    /// Use one probe of the parallelogram's area: for wide cones, which need not be sharp.
    bool round = false;
};

/// The texture at uv (v downwards from the image's top row), averaged over the footprint. If the footprint is smaller
/// than a texel: the bilinear value, or the nearest texel if the reference says so.
/// A coordinate that is not finite, or beyond 1e6, counts as 0. A footprint that is not finite gives the image's mean.
glm::vec4 sample_texture(const TextureSet& set, const TextureUse& use, const glm::vec2& uv,
                         const UvFootprint& footprint);

/// Part of a surface around a point. If all values are zero, textures are read at the point itself.
struct RayFootprint {
    /// m, world: from this camera ray's point to its neighbours' points. The part is the parallelogram that they span.
    glm::vec3 dx{0.0f}, dy{0.0f};
    float width = 0.0f;  ///< m; for rays over a hemisphere or a light: side of a square of the ray's share of the area
    bool whole_pixel = false;  ///< no other ray shows the pixel
};

/// The footprint of a camera ray, from the points where the rays of neighbouring samples meet the tangent plane
/// (exact).
/// @param distance  along the ray, m
/// @param spacing  of the samples, pixels: 1 / sqrt(samples per pixel)
RayFootprint make_pixel_footprint(const CameraView& view, const SurfacePoint& point, const glm::vec3& direction,
                                  float distance, float spacing);

/// The footprint, where it meets a surface at a distance (m), of a ray that represents a solid angle (sr).
RayFootprint make_cone_footprint(const SurfacePoint& point, const glm::vec3& direction, float distance,
                                 float solid_angle);

/// Its area, m2.
/// @param cosine  between the ray and the true normal, at least 0
float cone_footprint_area(float cosine, float distance, float solid_angle);

/// The footprint in one of the surface's sets of texture coordinates.
UvFootprint make_uv_footprint(const SurfacePoint& point, const RayFootprint& footprint, int uv_set);

}  // namespace aleph
