#pragma once
// The table of effects: one row for each, with all that a plan, its JSON, `aleph explain`, the picture of effects and
// --forbid know of it. README.md says how to add one.

#include <nlohmann/json_fwd.hpp>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/rays/hit.h"
#include "render/plan/effects_plan.h"

namespace aleph {

/// The frame that is planned, as effects look at it.
struct Planning {
    const Scene& scene;
    const RenderSettings& settings;
    const PlanInput& in;
    const std::optional<VisibleFrame>& visible;
    double left = 0.0;  ///< visible thresholds that may still be left out
    EffectsPlan plan;   ///< of the effects that stand before this one in the table

    bool any_seen(bool MaterialFacts::*layer) const;
    /// The user lets the plan decide about this effect.
    bool may_leave_out(Effect effect) const;
    /// @param everywhere  it changes pixels that show no surface too
    EffectBound bound_of(double radiance, bool everywhere = false) const;
};

/// The answer of an effect to a frame.
struct Finding {
    PlannedEffect planned;
    /// In place of it, where this bound fits into what may still be left out.
    std::optional<PlannedEffect> cheaper = std::nullopt;
};

Finding simulate(std::string reason);
Finding skip(std::string reason);
/// @param yes, no  the reasons
Finding simulate_if(bool there, const char* yes, const char* no);

/// Skips what adds nothing, or so little that it fits into what may be left out.
/// @param some, none  the reason where it adds something, and where it adds nothing
Finding simulate_if_visible(const Planning& frame, double radiance, const std::string& some, const char* none);

/// Skips what a setting leaves out.
/// @param radiance  infinite where there is no bound
Finding leave_to_user(const Planning& frame, std::string reason, double radiance);

struct EffectRow {
    EffectName effect;
    /// Looks for the effect in the frame's facts, and bounds what leaving it out changes.
    Finding (*find)(Planning& frame);
    /// Its colour in the picture of effects; black if it changes no light of a pixel.
    Rgb color{0.0f};
    /// Surfaces that have that colour where the effect is left out; null: all.
    bool (*shows)(const MaterialFacts& material, const FrameFacts& facts) = nullptr;
    /// How --forbid leaves it out of the scene or of the settings. Null for what frames and shading leave out: they ask
    /// EffectsPlan::skips and ShadingScene::skipped.
    void (*remove)(Scene& scene) = nullptr;
    void (*turn_off)(RenderSettings& settings) = nullptr;
};

/// Several effects have this colour: reflections, glass, and light that these pass on.
inline constexpr Rgb violet{0.5f, 0.1f, 0.8f};

/// Families of rows that share functions.
EffectTable light_effects();
EffectTable indirect_effects();
EffectTable object_effects();
EffectTable view_effects();

/// {"effect":NAME,"decision":"simulate|simplify|skip","reason":...,"bound":{"luminance":cd/m2,"thresholds":...}}; a
/// bound is null where none is known.
nlohmann::ordered_json to_json(const PlannedEffect& planned);

/// All effects, in order; an empty list for a plan that was not made: pictures without a scene have none.
nlohmann::ordered_json to_json(const EffectsPlan& plan);

/// For each pixel the mean colour of the effects that its surface has and that are left out; black where all are
/// simulated, and behind all surfaces.
Image<Rgb> make_effect_picture(const Image<Hit>& hits, const FrameFacts& facts, const EffectsPlan& plan,
                               std::size_t instances, const EffectTable& table = effect_table());

}  // namespace aleph
