#pragma once
// Makes one frame's effects plan. Internal to effects_plan*.cpp.

#include "render/plan/effects_plan.h"

namespace aleph {

class Planner {
  public:
    Planner(const PlanInput& input, const std::optional<VisibleFrame>& visible)
        : in_(input), visible_(visible), left_(planned_thresholds(input.settings)) {}

    EffectsPlan make();

  private:
    using E = Effect;

    bool any(bool MaterialFacts::*what) const;
    bool any_seen(bool MaterialFacts::*what) const;
    bool has_light(LightFacts::Kind kind) const;
    bool scatters() const;
    void set(Effect effect, Decision decision, std::string reason, std::optional<EffectBound> bound = EffectBound{});
    EffectBound bound_of(double radiance, bool everywhere = false) const;
    /// Whether so much may be left out, which is then spent. Forced effects spend nothing.
    bool spend(Effect effect, const EffectBound& bound);
    void skip_if_invisible(Effect effect, double radiance, const std::string& some, const std::string& none);
    /// @param radiance  infinite where there is no bound
    void leave_to_user(Effect effect, std::string reason, double radiance);
    double largest_contrast() const;
    /// Effects that are there, or are not.
    void plan_presence();
    /// Lights that can hardly bring anything are left out, the dimmest first.
    void plan_lights();
    void plan_shadows();
    void plan_indirect();
    void plan_lobes();
    /// Blur that is so small that the picture hardly changes.
    void plan_blur(Effect effect, double size, const BlurMoments& blur, const char* what);
    void plan_camera();
    void plan_shapes();
    void plan_vision();
    void plan_motion();
    /// --plan off simulates what the plan would leave out; --force and --forbid have the last word.
    void override_by_user();
    void simulate(Effect effect, std::string reason) { set(effect, Decision::simulate, std::move(reason)); }
    void skip(Effect effect, std::string reason) { set(effect, Decision::skip, std::move(reason)); }

    const PlanInput& in_;
    const std::optional<VisibleFrame>& visible_;
    double left_;  ///< visible thresholds that may still be left out
    EffectsPlan plan_;
};

}  // namespace aleph
