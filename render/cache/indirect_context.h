#pragma once
// Inputs of a frame's indirect light.

#include <optional>
#include <vector>

#include "render/cache/irradiance_cache.h"
#include "render/pixels/frame_checkpoint.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/pixels/shaded_frame.h"
#include "render/settings/settings.h"

namespace aleph {

/// Indirect light of a frame that is known before its cache is filled.
struct CarriedLight {
    virtual ~CarriedLight() = default;
    /// Irradiance at a surface of the frame; nothing where it is not known to this accuracy. Called from any thread.
    /// @param task  casts rays in the frame's scene to records where something may stand in between
    /// @param used  increased by the records that are used; may be null
    virtual std::optional<Rgb> find(const PixelSurface& surface, float accuracy, RayTask& task,
                                    RecordUse* used = nullptr) const = 0;
    /// Records of light of further bounces that hold in this scene (FurtherBounces); none if it has to be solved.
    virtual std::vector<IrradianceRecord> find_further(const ShadingScene&) const { return {}; }
};

/// Bounces of the light beside the one that is gathered.
struct BounceContext {
    MultiBounceLight further{};  ///< of fewer bounces than the light that is gathered
    int before = 0;              ///< at Lambert layers, between the picture and the surfaces whose light is gathered
};

/// Inputs of a frame's indirect light.
struct IndirectContext {
    const LightingContext& lighting;
    const CameraView& view;
    const RenderSettings& settings;
    const Image<float>& accuracy;           ///< alpha per pixel
    std::uint32_t frame = 0;                ///< for random numbers: SamplePlace::noise_key
    float max_radius = 1.0f;                ///< m, of records: scene_radius
    FrameProgress progress;                 ///< may be empty
    FrameCheckpoint* checkpoint = nullptr;  ///< keeps the results of gathers; may be null
    /// Direct light that gathers share; filled along with the cache. Null: each computes its own, without bias.
    DirectGrid* direct = nullptr;
    const BrightSurfaces* bright = nullptr;  ///< that gathers and samples aim at, at least one; null: none
    const CarriedLight* carried = nullptr;   ///< surfaces that it knows get no records; may be null
    /// If set, the hits were cast in this pose of the scene, and the light is wanted where their surfaces are in
    /// `lighting` (carry_point).
    const ShadingScene* seen = nullptr;
    /// Luminance that the mean of a pixel's samples may err by: records are computed only where they cost less than
    /// rays of samples. Null: everywhere.
    const Image<float>* tolerance = nullptr;
    BounceContext bounces{};
};

/// The context of a frame for a list of places instead of its pixels.
/// @param accuracy  alpha per place; must outlive the result
inline IndirectContext make_places_context(const IndirectContext& frame, const Image<float>& accuracy) {
    return {.lighting = frame.lighting,
            .view = frame.view,
            .settings = frame.settings,
            .accuracy = accuracy,
            .frame = frame.frame,
            .max_radius = frame.max_radius,
            .progress = frame.progress,
            .checkpoint = frame.checkpoint,
            .direct = frame.direct,
            .bright = frame.bright,
            .bounces = frame.bounces};
}

}  // namespace aleph
