#pragma once
// Lamps out of focus. The lens spreads a small lamp over a disc of the picture: hardly any point of the lens shows it
// to a pixel there, and at the disc's rim hardly any place in the pixel's filter. All rays of a place in the picture
// meet in one point of the plane that is sharp, so a place in the disc and a place on the lamp tell the point of the
// lens.

#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "render/shade/picture_polygon.h"
#include "render/shade/sample_shading.h"

namespace aleph {

/// The small bright lamps that are out of focus.
struct LensLight {
    struct Lamp {
        int instance = no_index;
        glm::dvec2 middle{0.0};  ///< pixels, of the disc
        double radius = 0.0;     ///< pixels, no smaller than the disc's
        double bright = 0.0;     ///< about its luminance in the picture
    };
    static constexpr int tile = 8;  ///< pixels

    std::vector<Lamp> lamps;
    Image<std::vector<int>> tiles;  ///< of the picture: lamps that may be seen there
};

/// Nothing where there are none.
std::optional<LensLight> find_lens_light(const LightingContext& context, const CameraView& view, const Lens& lens,
                                         double exposure);

/// Rays of one pixel towards such lamps.
class LensPixel {
  public:
    LensPixel(const LensLight& light, PixelFilter filter, const glm::ivec2& pixel);

    const glm::ivec2& pixel() const { return pixel_; }

    /// What is to be added to a sample's emission. Another ray, towards one of the lamps, finds its light; where both
    /// kinds of rays could meet it, each counts by its density (balance heuristic, Veach and Guibas 1995).
    /// @param place      of the sample, with an open lens
    /// @param hit        of its own ray
    /// @param direction  of that ray, unit
    Rgb correct(const SampleScene& scene, RayTask& task, const SamplePlace& place, const Hit& hit,
                const glm::vec3& direction) const;

  private:
    /// A disc, as far as it lies in the pixel's filter.
    struct Part {
        const LensLight::Lamp* lamp = nullptr;
        PicturePolygon polygon;  ///< around it; none: places are those of the filter
        double density = 0.0;    ///< of rays: per square pixel, or over that of the filter
    };
    struct Focus;

    double weigh(const glm::dvec2& place) const;
    double find_density(const SampleScene& scene, const Focus& focus, const Hit& hit, const glm::vec3& direction) const;
    Rgb find_lamp(const SampleScene& scene, RayTask& task, const SamplePlace& place, int index) const;

    glm::ivec2 pixel_;
    PixelFilter filter_;
    std::vector<Part> parts_;
    std::vector<float> ends_;  ///< share of the rays up to each of them, it included
};

}  // namespace aleph
