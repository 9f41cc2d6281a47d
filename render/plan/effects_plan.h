#pragma once
// The plan of a frame's effects: each is simulated, simplified or skipped, with the reason and a bound on what that can
// change. It is made from data, before the frame is shaded.

#include <optional>

#include "render/plan/effect_facts.h"
#include "render/settings/settings.h"

namespace aleph {

enum class Decision {
    simulate,
    simplify,  ///< a part is left out
    skip,
};

/// The most that a pixel changes by what is left out.
struct EffectBound {
    double luminance = 0.0;   ///< cd/m2, exposure applied
    double thresholds = 0.0;  ///< of the least visible threshold where it can change the frame
};

struct PlannedEffect {
    Decision decision = Decision::simulate;
    std::string reason;
    /// Nothing where the user chose to leave the effect out, and no bound is known.
    std::optional<EffectBound> bound = EffectBound{};
    bool by_user = false;  ///< a setting leaves it out, not the plan
    bool spares = false;   ///< leaving it out spares work, even where it changes nothing
    const char* name = "";

    /// True if something that is there is left out. An effect with a bound of 0 is mostly not there.
    bool leaves_out() const { return decision != Decision::simulate && (!bound || bound->luminance > 0.0 || spares); }
};

struct EffectsPlan {
    std::vector<PlannedEffect> effects;  ///< in the order of Effect; empty until the plan is made
    std::vector<LightFacts> lights_left_out;
    bool points_unshadowed = false;  ///< lights without area need no shadow rays

    const PlannedEffect& of(Effect effect) const { return effects.at(static_cast<std::size_t>(effect)); }
    PlannedEffect& of(Effect effect) { return effects.at(static_cast<std::size_t>(effect)); }
    bool skips(Effect effect) const { return of(effect).decision == Decision::skip; }
    /// The effects that shading has to leave out. Those that are not there need not be: gloss that cannot be seen still
    /// lights what is.
    EffectSet left_out() const;
    /// Sum of the bounds of what the plan leaves out, visible thresholds.
    double left_out_thresholds() const;
};

/// Share of the tolerated error that everything left out may take: of a visible threshold without an error that is
/// asked for, else of that error.
inline constexpr double plan_share = 0.1, plan_share_of_error = 0.05;

/// Thresholds that the bounds of what is left out may add up to.
inline double planned_thresholds(const RenderSettings& settings) {
    return settings.error > 0.0 ? plan_share_of_error * settings.error : plan_share;
}

/// How far blur moves what a pixel shows, in pixels: over the shutter's time, or over the lens.
struct BlurMoments {
    double mean = 0.0;         ///< distance from where the sharp picture has it
    double shift = 0.0;        ///< length of the mean displacement
    double mean_square = 0.0;  ///< of the distance
};

/// The shutter of a frame's camera.
struct ShutterFacts {
    bool open = false;           ///< for some time
    bool changes = false;        ///< something does while it is open
    bool world_changes = false;  ///< more than the camera does, so that bounds of light at one time do not hold
    bool light_changes = false;  ///< what sends light does (LightBreaks)
    /// How far the picture moves, where only the camera does; nothing if more than the picture's place may change.
    std::optional<BlurMoments> blur;
    double largest = 0.0;  ///< of these distances, pixels, from the first to the last
};

struct LensFacts {
    double radius = 0.0;  ///< m
    double circle = 0.0;  ///< pixels: largest diameter of the circle of confusion
};

/// Facts of a frame that are known when its plan is made.
struct PlanInput {
    FrameFacts facts;
    ShutterFacts shutter;
    LensFacts lens;
    bool perceives = false;        ///< something obeys the model of vision, or its maps are wanted
    bool maps = false;             ///< they are
    bool has_other = true;         ///< there is another frame to which the picture moves
    bool moves = true;             ///< something is at another place then
    bool keyframes = false;        ///< lighting keyframes can serve the frame
    double luminance_scale = 1.0;  ///< cd/m2 per radiance: exposure and the display's white
};

/// A frame once it has been estimated.
struct VisibleFrame {
    double threshold = 0.0;    ///< cd/m2, the least of all pixels
    double on_surfaces = 0.0;  ///< the least of those that show surfaces, and of those beside them
    double brightest = 0.0;    ///< cd/m2, of the estimate
};

struct EffectRow;
using EffectTable = std::vector<EffectRow>;  ///< in the order of Effect

const EffectTable& effect_table();

/// @param visible  nothing before the estimate: then only what cannot change the picture at all is skipped
EffectsPlan plan_effects(const Scene& scene, const RenderSettings& settings, const PlanInput& input,
                         const std::optional<VisibleFrame>& visible, const EffectTable& table = effect_table());

/// Takes forbidden effects out of a scene, where they come from the scene alone: textures, emission and the like.
/// Others are left out of the work of each frame.
void remove_forbidden(const EffectSet& forbidden, Scene& scene, const EffectTable& table = effect_table());

/// Settings under which forbidden effects are not computed.
RenderSettings without_forbidden(RenderSettings settings, const EffectTable& table = effect_table());

}  // namespace aleph
