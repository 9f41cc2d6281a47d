#pragma once
// Checks the light of lighting keyframes at a frame between them: both may agree and be wrong (README.md).

#include <cstdint>
#include <span>

#include "render/cache/cache_fill.h"

namespace aleph {

/// Where the light of a frame may differ from that of the lighting keyframes around it.
struct KeyframeRisk {
    std::vector<std::uint8_t> moving;  ///< per instance: it moves, deforms, comes or goes
    /// Around moving instances, at the frame and at the lighting keyframes; relative to the frame's anchor.
    std::vector<BoundingSphere> movers;
};

KeyframeRisk find_keyframe_risk(const ShadingScene& shading, const PosePlan& plan,
                                std::span<const ShadingScene* const> keyframes);

/// Light of lighting keyframes, but for parts of the picture where it is not to be used.
class CheckedLight final : public CarriedLight {
  public:
    /// Keeps references. Until `check`, probed parts are not used: their light may turn out not to be known.
    /// @param context  of the frame; `carried` is the light of lighting keyframes
    CheckedLight(const IndirectContext& context, const KeyframeRisk& risk, const SampleHits& sample);

    /// Computes irradiance at the probes, as records of the frame's cache, and compares it.
    /// @param context  as at construction, with multi_bounce light
    void check(IrradianceCache& cache, const IndirectContext& context, FrameTally& tally);

    std::optional<Rgb> find(const PixelSurface& surface, float accuracy, RayTask& task,
                            RecordUse* used = nullptr) const override;

  private:
    struct Probe {
        int x = 0, y = 0;  ///< pixel
        bool moving = false;
        int reach = 0;  ///< tiles around the probe's that depend on it
    };
    void add_probes(const IndirectContext& context, int tile_x, int tile_y);
    void reject(const Probe& probe);
    /// A probe whose records differ is gathered again, since noise alone makes some of many differ.
    /// @param context  without the direct light that gathers share: a resumed frame has not all of it yet
    bool differs(const IrradianceCache& cache, const IndirectContext& context, const Probe& probe, RayTask& task) const;

    const CarriedLight& keyframes_;
    const KeyframeRisk& risk_;
    const SampleHits& sample_;
    const CameraView& view_;
    glm::dvec3 anchor_;
    std::vector<Probe> probes_;
    Image<std::uint8_t> rejected_;  ///< per tile, a bit for what stands still and one for what moves
};

}  // namespace aleph
