#pragma once
// Light along paths: what reaches a surface point by any number of scattering events, without bias. Path tracing with
// next-event estimation (Kajiya 1986) and multiple importance sampling (Veach 1997), ended by Russian roulette.

#include "render/light_choice.h"

namespace aleph {

/// How far paths go on.
struct PathLimits {
    int bounces = 0;  ///< times that a Lambert layer may turn the path
    int depth = 0;    ///< surfaces that may scatter, of all kinds
};

/// What encloses a ray: meshes with a volume (KHR_materials_volume) that it has entered, the innermost last.
class Media {
  public:
    struct Medium {
        int material = no_index;
        float ior = 1.0f;
        Rgb attenuation{0.0f};  ///< 1/m
    };

    /// 1 outside of all.
    float ior() const { return size_ == 0 ? 1.0f : stack_[size_ - 1].ior; }
    /// 1/m, of the innermost; 0 outside.
    Rgb attenuation_inside() const;
    /// 1/m, of the ray that ends at this surface. If no mesh was entered and the surface is met from inside, the ray
    /// started inside: the camera is in the glass.
    Rgb attenuation(const ViewedSurface& end) const;
    /// Of the far side over the viewer's side, at a surface with a volume.
    float ratio_at(const ViewedSurface& surface) const;
    /// Goes through a surface with a volume, by the side that was hit.
    void pass(const ViewedSurface& surface);

  private:
    int find(int material) const;

    std::array<Medium, 4> stack_{};  ///< deeper nesting than this is ignored
    int size_ = 0;
};

/// How light counts that the next ray meets straight away at a lamp or the environment.
enum class EmissionWeight : std::uint8_t {
    full,      ///< nothing else can find it: a camera ray, a mirror
    weighted,  ///< against sampling the light itself
    none,      ///< it is already counted
};

/// A path up to its last ray.
struct PathState {
    PathLimits left;
    Rgb throughput{1.0f};
    EmissionWeight emission = EmissionWeight::full;
    float pdf = 0.0f;        ///< density of the last turn, per steradian, if `weighted`
    Receiver from;           ///< where it turned
    int roulette_after = 4;  ///< surfaces that scatter before Russian roulette may end the path
    Media media;
};

/// Light that the surface scatters towards its viewer, without its own emission.
Rgb scatter_light(const LightingContext& context, RayTask& task, ViewedSurface surface, PathState state,
                  RandomStream& random);

/// Light that comes back along a sampled direction: from lamps and the environment that the ray meets, and what the
/// surface there scatters, within the state's limits. Its weight is included.
Rgb follow_sample(const LightingContext& context, RayTask& task, const LitSurface& lit, const ScatterSample& sample,
                  PathState state, RandomStream& random);

}  // namespace aleph
