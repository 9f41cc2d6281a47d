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
// - What fades. Of the light from things whose material changes by a share, so much may change.
// - Lights that things hide at one time and not at another (shutter_shadows.h).
// - Other light that things let in or shut out far away: a few paths measure it (shutter_probes.h).
// - Lights that move. What one brings from a distance d changes by about 3 (s / d + a) of it, a the angle by
//   which it turns or its cone widens. All of the light may be that of the one that changes most.
// - Lights that brighten or dim, by a share of the brighter one. More than a quarter ends all such light (LightBreaks).
// Elsewhere light is found at the sample's own time, by a path.
//
// Where that is much of a picture, indirect light is computed at several times of the shutter (shutter_keys.h), and
// interpolated linearly between two of them, a weighing 1 - w and b weighing w. What a change of light brings then is
// at most (1 - w) times that from a plus w times that from b (triangle inequality). Where lights move straight on, the
// first order cancels: for light that falls off as 1 / d^2, 3 ((1 - w) s_a^2 + w s_b^2) / d^2 is left, and 3 times
// their distance from the straight line over d. How far brightness lies from linear is known exactly.

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "render/cache/indirect_context.h"
#include "render/time/shutter_probes.h"

namespace aleph {

/// A thing or a light that moves between the shutter's centre and a sample's time: two spheres around it, in the
/// frame's coordinates.
struct ShutterMover {
    int instance = no_index;
    glm::vec3 centers[2]{};  ///< m, at the frame's time and at the sample's; infinite for light from afar
    float radius = 0.0f;     ///< m, the larger one
    float moved = 0.0f;      ///< m, of its point that moves farthest; infinite if it is seen at one of the times only
    float bent = 0.0f;       ///< m, of a mesh that deforms: the farthest way of its points beside that of its centre
    float faded = 0.0f;      ///< of its light: the largest share by which its material differs, emission aside
    bool shines = false;
    float turned = 0.0f;   ///< radians, about, a wider cone and growth included; of what shines
    int light = no_index;  ///< its node; no_index: an instance or the environment
    float bend = std::numeric_limits<float>::infinity();  ///< m, from where interpolation between two times puts it;
                                                          ///< infinite: there is one time
};

/// Instances and lights that differ in place, direction or, emission aside, material between two poses of a scene.
std::vector<ShutterMover> find_movers(const ShadingScene& frame, const ShadingScene& sample);

/// Upper bound of the share of irradiance that a sphere hides at a distance from its centre.
float find_hidden_share(float radius, float distance);

/// An upper bound of the share of a point's light that things hide at one of the two times and not at the other, or
/// send to it at one of them alone.
/// @param position  m, where the point is at the frame's time
/// @param moved     m, from there to where it is at the sample's time, in the frame's coordinates
/// @param instance  that the point is on: it moves along. The sum stops above `enough`
float find_hidden_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved,
                         int instance, float enough);

/// About the share of a point's light that changes because lights move; the other parameters as above.
float find_light_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved);

/// Sets `bend` of lights of two times that are read.
/// @param weight  of `after`
void find_bends(std::vector<ShutterMover>& before, std::vector<ShutterMover>& after, float weight);

/// The largest share by which a light differs from the mean of two poses.
/// @param weight  of `after`
float find_dimming(const ShadingScene& before, const ShadingScene& after, float weight, const ShadingScene& sample);

/// Known indirect light of a frame, for surfaces seen at the time of one of its samples.
class ShutterLight {
  public:
    /// Keeps references. The poses are those of the shutter's centre and of the sample's time; both kinds of light are
    /// those of the frame's time, and may be null.
    ShutterLight(const ShadingScene& frame, const ShadingScene& sample, const CarriedLight* carried,
                 const IrradianceCache* cache);
    /// Light that is interpolated between two times, for the sample's surfaces.
    /// @param weight  of `after`; 0: `before` is all
    ShutterLight(const ShadingScene& before, const ShadingScene& after, float weight, const ShadingScene& sample,
                 const CarriedLight* between);

    /// Takes the changes of light that are measured (shutter_probes.h) as well. Keeps a reference.
    /// @param share  of them, at the sample's time
    void add_changes(const LightChanges& changes, float share) {
        changes_ = &changes;
        changes_share_ = share;
    }

    /// Returns whether light is that of the shutter's centre, and nothing but the camera differs at the sample's time.
    bool is_still() const { return at_center_ && keys_.front().movers.empty() && dimmed_ == 0.0f; }
    /// Returns whether a thing or a light is elsewhere, turned or of another material at a time that is read.
    bool has_movers() const {
        return std::ranges::any_of(keys_, [](const Key& key) { return !key.movers.empty(); });
    }
    /// Returns whether light of the shutter's centre is read.
    bool is_at_center() const { return at_center_; }

    /// Irradiance at a surface of the sample's time, where it is known to this accuracy. Any thread may call it.
    /// @param task  casts rays at the shutter's centre; between two times, at the sample's
    std::optional<Rgb> find(const PixelSurface& surface, float accuracy, RayTask& task,
                            RecordUse* used = nullptr) const;

    /// A surface of the sample's time where its light is read. Changes are means over these times.
    struct Reading {
        SurfacePoint point;   ///< at the first
        float moved = 0.0f;   ///< m
        float change = 0.0f;  ///< of its light, or more if the surface turns by more than a record's may
    };
    /// Nothing if it is hidden at one of the times. @param enough  change that need not be exceeded
    std::optional<Reading> find_change(const PixelSurface& surface, float enough) const;

  private:
    /// A time at which light is known.
    struct Key {
        const ShadingScene& shading;
        float weight = 1.0f;
        glm::vec3 shift;  ///< m, from the coordinates of the sample's time to those of this one
        std::vector<ShutterMover> movers;
    };
    static Key make_key(const ShadingScene& at, float weight, const ShadingScene& sample);
    std::optional<Rgb> read(const PixelSurface& still, float accuracy, RayTask& task, RecordUse& used) const;

    std::vector<Key> keys_;  ///< one or two
    const CarriedLight* carried_;
    const IrradianceCache* cache_ = nullptr;
    float dimmed_;                           ///< share of all light that lights which dim or are hidden may change
    const LightChanges* changes_ = nullptr;  ///< null: none are measured
    float changes_share_ = 0.0f;
    bool at_center_ = false;
};

}  // namespace aleph
