#include "render/plan/effect_table.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "render/plan/effect_bounds.h"

namespace aleph {

namespace {

/// @param radiance  at the time of the frame's facts
EffectBound bound_over_shutter(const Planning& frame, double radiance) {
    return frame.bound_of(frame.in.shutter.world_changes ? unbounded : radiance);
}

}  // namespace

const EffectTable& effect_table() {
    static const EffectTable table = [] {
        EffectTable rows;
        for (const auto family : {light_effects, indirect_effects, object_effects, view_effects}) {
            for (const EffectRow& row : family()) rows.push_back(row);
        }
        std::ranges::sort(rows, {}, [](const EffectRow& row) { return row.effect.id; });
        return rows;
    }();
    return table;
}

bool Planning::any_seen(bool MaterialFacts::*layer) const {
    return std::ranges::any_of(in.facts.objects,
                               [&](const ObjectFacts& o) { return in.facts.is_seen(o) && o.material.*layer; });
}

bool Planning::may_leave_out(Effect effect) const {
    return settings.effects.plan == EffectsPlanning::on && !settings.effects.force.contains(effect);
}

EffectBound Planning::bound_of(double radiance, bool everywhere) const {
    const double luminance = radiance > 0.0 ? radiance * in.luminance_scale : 0.0;
    double threshold = 0.0;
    if (visible) threshold = everywhere ? visible->threshold : visible->on_surfaces;
    return {luminance, luminance > 0.0 ? luminance / threshold : 0.0};
}

Finding simulate(std::string reason) {
    return {{.decision = Decision::simulate, .reason = std::move(reason)}};
}

Finding skip(std::string reason) {
    return {{.decision = Decision::skip, .reason = std::move(reason)}};
}

Finding simulate_if(bool there, const char* yes, const char* no) {
    return there ? simulate(yes) : skip(no);
}

Finding simulate_if_visible(const Planning& frame, double radiance, const std::string& some, const char* none) {
    const EffectBound bound = bound_over_shutter(frame, radiance);
    if (bound.luminance == 0.0) return skip(none);
    Finding finding = simulate(some);
    finding.cheaper = {.decision = Decision::skip, .reason = some + ", but too little to be seen", .bound = bound};
    return finding;
}

Finding leave_to_user(const Planning& frame, std::string reason, double radiance) {
    Finding finding = skip(std::move(reason));
    finding.planned.by_user = true;
    finding.planned.bound = bound_over_shutter(frame, radiance);
    if (!std::isfinite(finding.planned.bound->luminance)) finding.planned.bound.reset();
    return finding;
}

namespace {

Rgb mix(const EffectTable& left_out, const MaterialFacts& material, const FrameFacts& facts) {
    Rgb sum(0.0f);
    float count = 0.0f;
    for (const EffectRow& row : left_out) {
        if (row.shows != nullptr && !row.shows(material, facts)) continue;
        sum += row.color;
        count += 1.0f;
    }
    return count > 0.0f ? sum / count : sum;
}

}  // namespace

Image<Rgb> make_effect_picture(const Image<Hit>& hits, const FrameFacts& facts, const EffectsPlan& plan,
                               std::size_t instances, const EffectTable& table) {
    EffectTable left_out;
    for (const EffectRow& row : table) {
        if (row.color != Rgb(0.0f) && plan.of(row.effect.id).leaves_out()) left_out.push_back(row);
    }
    std::vector<Rgb> colors(instances, Rgb(0.0f));
    for (const ObjectFacts& object : facts.objects) colors[object.instance] = mix(left_out, object.material, facts);
    return map_pixels([&](const Hit& hit) { return hit.instance == no_index ? Rgb(0.0f) : colors[hit.instance]; },
                      hits);
}

}  // namespace aleph
