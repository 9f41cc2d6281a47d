#pragma once
// Indirect light of samples that are taken while the shutter is open, each at a time of its own.
//
// Indirect light changes slowly, so it is taken to stay on its surface: a point is carried to where it lies at the
// shutter's centre, and the light of the lighting keyframes or of the frame's cache is read there. That holds where the
// light changes by less than alpha, the accuracy of the pixel, and only there it is used:
// - What stands still. The point moves by less than the reach of the records that it reads, and its normal turns by no
//   more than a record's may (irradiance_record.h).
// - What moves. A sphere of radius r at distance d hides at most F = min(1, r^2 / d^2) of the light that arrives. If it
//   moves by s, F changes by no more than min(F, 3 F s / d). The sum over all things that move is at most alpha.
// - Lights that move. What one brings from a distance d changes by about min(1, 3 (s / d + a)) of it, a the angle by
//   which it turns or its cone widens. All of the light may be that of the one that changes most.
// - Lights that brighten or dim, by a share of the brighter one. More than a quarter ends all such light (LightBreaks).
// Elsewhere light is found at the sample's own time, by a path.

#include <optional>
#include <vector>

#include "render/cache/indirect_context.h"

namespace aleph {

/// A thing or a light that moves between the shutter's centre and a sample's time: two spheres around it, in the
/// frame's coordinates.
struct ShutterMover {
    int instance = no_index;
    glm::vec3 centers[2]{};  ///< m, at the frame's time and at the sample's; infinite for light from afar
    float radius = 0.0f;     ///< m, the larger one
    float moved = 0.0f;      ///< m, of its point that moves farthest; infinite if it is seen at one of the times only
    float bent = 0.0f;       ///< m, of a mesh that deforms: the farthest way of its points beside that of its centre
    bool shines = false;
    float turned = 0.0f;  ///< radians, about, a wider cone and growth included; of what shines
};

/// Instances and lights that differ in place or direction between two poses of a scene.
std::vector<ShutterMover> find_movers(const ShadingScene& frame, const ShadingScene& sample);

/// An upper bound of the share of a point's light that things hide at one of the two times and not at the other.
/// @param position  m, where the point is at the frame's time
/// @param moved     m, from there to where it is at the sample's time, in the frame's coordinates
/// @param instance  that the point is on: it moves along. The sum stops above `enough`
float find_hidden_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved,
                         int instance, float enough);

/// About the share of a point's light that changes because lights move; the other parameters as above.
float find_light_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved);

/// The largest share by which a light of either pose is brighter than in the other one.
float find_dimming(const ShadingScene& frame, const ShadingScene& sample);

/// Known indirect light of a frame, for surfaces seen at the time of one of its samples.
class ShutterLight {
  public:
    /// Keeps references. The poses are those of the shutter's centre and of the sample's time; both kinds of light are
    /// those of the frame's time, and may be null.
    ShutterLight(const ShadingScene& frame, const ShadingScene& sample, const CarriedLight* carried,
                 const IrradianceCache* cache)
        : frame_(frame),
          shift_(sample.anchor - frame.anchor),
          carried_(carried),
          cache_(cache),
          movers_(find_movers(frame, sample)),
          dimmed_(find_dimming(frame, sample)) {}

    /// Returns whether nothing but the camera differs at the sample's time.
    bool is_still() const { return movers_.empty() && dimmed_ == 0.0f; }

    /// Irradiance at a surface of the sample's time, where it is known to this accuracy. Any thread may call it.
    /// @param task  casts rays at the shutter's centre
    std::optional<Rgb> find(const PixelSurface& surface, float accuracy, RayTask& task,
                            RecordUse* used = nullptr) const;

  private:
    std::optional<Rgb> read(const PixelSurface& still, float accuracy, RayTask& task, RecordUse& used) const;

    const ShadingScene& frame_;
    glm::vec3 shift_;  ///< m, from the coordinates of the sample's time to those of the frame's
    const CarriedLight* carried_;
    const IrradianceCache* cache_;
    std::vector<ShutterMover> movers_;
    float dimmed_;
};

}  // namespace aleph
