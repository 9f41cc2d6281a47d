#pragma once
// Textures of pixels that show one flat face. Samples of such a pixel differ mostly because they lie at different
// places of its texture, and a look-up costs a fraction of a sample. So each sample is corrected by how much its texel
// differs from the mean of other texels of the pixel: a control variate, which leaves the mean over seeds as it is.

#include <span>

#include "render/pixels/frame_checkpoint.h"
#include "render/pixels/pixel_samples.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/shade/progressive.h"

namespace aleph {

/// The texture of one pixel, on the plane of the triangle at its centre, whatever lies before that plane.
class PixelTexture {
  public:
    /// @param surface  at the pixel's centre, with the texture of its base colour
    /// @param scale    from texel to the radiance that is expected; finite
    PixelTexture(const ShadingScene& shading, const CameraView& view, const PixelSurface& surface,
                 const TextureUse& texture, const Rgb& scale);

    /// The correction of a sample: the mean over other places in the pixel of the radiance that is expected there,
    /// less that at the sample's own place. Its mean over seeds is 0. 0 if the triangle has no area.
    Rgb correct(const SamplePlace& place) const;
    const glm::ivec2& pixel() const { return pixel_; }

  private:
    Rgb expect(const glm::dvec2& film, float spacing) const;

    const ShadingScene& shading_;
    const CameraView& view_;
    const TextureUse& texture_;
    const glm::ivec2 pixel_;
    const glm::dvec3 position_;    ///< m, of the centre's point
    glm::dvec3 normal_{0.0};       ///< of the plane; any length, 0 if there is none
    glm::dvec3 uv_slopes_[2]{};    ///< 1/m: change of u and of v along the plane
    const glm::dvec2 uv_;          ///< of the centre's point
    const UvFootprint footprint_;  ///< of the whole pixel
    const Rgb scale_;
};

/// The pixels of a frame that are corrected.
class TextureControl {
  public:
    /// Keeps references, but for the estimate. At first it corrects pixels that show a texture, and around which there
    /// is one object.
    /// @param estimate  quick estimate of the frame at the pixels' centres, with this exposure
    TextureControl(const ShadingScene& shading, const CameraView& view, const SampleHits& centers,
                   const Image<Rgb>& estimate, double exposure);

    bool corrects(int x, int y) const { return corrects_(x, y) != 0; }
    /// Undefined where it does not.
    PixelTexture find_texture(int x, int y) const;
    /// Leaves out the pixels of a stage where it does not pay: where the errors of the means around would hardly be
    /// larger without corrections.
    void choose(std::span<const PixelRange> stage, const Image<PixelSamples>& pixels);

    void save(ByteWriter& out) const { out.add(corrects_.pixels); }
    void restore(ByteReader& in) { corrects_.pixels = in.read_all<std::uint8_t>(); }

  private:
    const ShadingScene& shading_;
    const CameraView& view_;
    const SampleHits& centers_;
    Image<Rgb> scales_;  ///< from the texel at a pixel's centre to the light that the surface reflects there
    Image<std::uint8_t> corrects_;
};

}  // namespace aleph
