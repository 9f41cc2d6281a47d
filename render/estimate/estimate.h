#pragma once
// The quick estimate of a frame: a cheap picture for the model of vision, which is not part of the rendered frame. Its
// indirect light is irradiance gathered at few pixels, the nodes, and a smooth interpolation between them.

#include <optional>

#include "render/path/path.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/settings/settings.h"

namespace aleph {

class SightLine;

/// Surface that indirect light finds at a pixel.
struct DiffuseSurface {
    glm::vec3 position{0.0f};  ///< m, relative to the anchor
    glm::vec3 normal{0.0f};    ///< unit
    float footprint = 0.0f;    ///< size of a pixel at that distance, m; 0: nothing that reflects diffusely
    Rgb reflected{0.0f};       ///< radiance towards the viewer per unit of irradiance
};
DiffuseSurface make_diffuse_surface(const PixelSurface& surface);

/// How nodes of one spacing are weighted: by a quadratic B-spline, which is smooth, or linearly, which keeps the values
/// of the nodes.
enum class NodeSpline { quadratic, linear };

/// Pixels at multiples of the finest spacing, where irradiance may be gathered. A coarser level has every 2nd, 4th ...
/// one.
class EstimateNodes {
  public:
    /// @param width, height  pixels of the picture
    EstimateNodes(int width, int height);

    struct Node {
        DiffuseSurface surface;
        Rgb irradiance{0.0f};
        bool known = false;  ///< the irradiance
    };

    int width() const { return width_; }
    int height() const { return height_; }
    int levels() const { return levels_; }
    /// Pixels between the nodes of a level; level 0 is the coarsest.
    int spacing(int level) const { return finest_ << (levels_ - 1 - level); }
    /// The node of a pixel that is one at some level.
    Node& node(int x, int y) { return nodes_(x / finest_, y / finest_); }
    const Image<Node>& nodes() const { return nodes_; }

    /// Irradiance and the confidence in it, [0,1]: from the coarsest level whose nodes lie on the surface that is asked
    /// for; where two levels meet, from both.
    struct Interpolated {
        Rgb irradiance{0.0f};  ///< times confidence
        float confidence = 0.0f;
    };
    /// @param pixel   place in the picture, pixels: 0 is the centre of the first one
    /// @param levels  how many of the levels to ask, from the coarsest
    Interpolated interpolate(const DiffuseSurface& here, const glm::dvec2& pixel, int levels, NodeSpline kind) const;

  private:
    Interpolated interpolate_level(const DiffuseSurface& here, const glm::dvec2& pixel, int spacing,
                                   NodeSpline kind) const;

    int width_, height_, levels_ = 1, finest_ = 1;
    Image<Node> nodes_;
};

/// Irradiance of the quick estimate that is known before any is gathered.
struct CarriedEstimate {
    virtual ~CarriedEstimate() = default;
    /// Nothing where it is not known. Called from any thread.
    virtual std::optional<Rgb> find(const PixelSurface& surface) const = 0;
};

/// Gathers at the nodes of each level at which coarser ones have nothing reliable to interpolate. All gathers have the
/// same random numbers, so their error varies as slowly as the light itself.
/// @param carried  where it knows the irradiance, none is gathered; may be null
EstimateNodes gather_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              const CarriedEstimate* carried, RayCounts& counts);

/// Irradiance between the nodes of a view, at any surface near it: the mean of all nodes where they do not tell. It has
/// none of the noise that the model of vision would take for detail. Biased: what is smaller than about 30 pixels of a
/// 640x480 picture, such as the shadow of a chair leg, is smoothed away.
class NodeIrradiance {
  public:
    /// Keeps a reference.
    explicit NodeIrradiance(const EstimateNodes& nodes);
    /// @param pixel  as in EstimateNodes::interpolate
    Rgb at(const DiffuseSurface& surface, const glm::dvec2& pixel) const;

  private:
    const EstimateNodes& nodes_;
    Rgb mean_;
};

struct EstimateOptions {
    EstimateKind kind = EstimateKind::direct;
    /// With `direct`: nodes of this view (gather_estimate), whose light of one bounce is added; may be null.
    const EstimateNodes* indirect = nullptr;
    double exposure = 1.0;
};

/// One sample at every pixel centre, from the frame's first hits; where surfaces are blended, through them. Exposure is
/// applied; values that are not finite are kept (perception/sanitize.h replaces them).
///
/// flat: albedo plus emission, as under constant white light; no rays for light.
///
/// direct: emission plus direct light from a fixed pattern of points per light (estimate_direct_light).
Image<Rgb> compute_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                            const EstimateOptions& options, RayCounts& counts);

/// Radiance that an estimate shows for the surface of a line of sight, without indirect light and exposure.
/// @param task  its rays are those of Blend::cutout
Rgb estimate_radiance(const SightLine& line, RayTask& task, EstimateKind kind);

/// Returns the radiance that an estimate shows for what surrounds the scene, without exposure.
Rgb estimate_surroundings(const SightLine& line, EstimateKind kind);

/// 0.18 / exp(mean log Y) over the pixels of an estimate with Y > 0; nothing if there are none.
std::optional<double> compute_exposure(const Image<Rgb>& estimate);

}  // namespace aleph
