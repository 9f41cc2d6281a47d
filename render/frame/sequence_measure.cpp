// Parts of frames, timed.

#include "render/frame/sequence.h"
#include "render/frame/sequence_state.h"
#include "render/guide/accuracy_map.h"

namespace aleph {

PartTimes Sequence::time_part(std::int64_t frame, const PicturePart& part, std::span<const RenderSettings> settings,
                              const std::function<bool(const PartTimes&)>& go_on) {
    SequenceState& s = state();
    PartTimes times;
    times.frame = s.holds.find_first(frame);
    FrameOutput out;
    FramePlan plan;
    StageClock clock;
    const SampleHits centers = s.look(times.frame, s.needs_perception(), false, out, plan);
    s.finish_plan(centers.hits, out, plan);
    clock.add_to(times.before);
    s.leave_out(plan.effects);
    const int bounces = plan.settings.bounces;
    for (const RenderSettings& chosen : settings) {
        plan.settings = chosen;
        plan.settings.bounces = bounces;
        if (s.needs_perception()) {
            out.alpha = compute_accuracy_map(out.perception.aleph, out.tolerance, chosen);
        }
        out.statistics.counts = {};
        SampleOptions options = s.find_sample_options(times.frame, plan);
        options.part = &part;
        s.shade(times.frame, centers, plan, nullptr, options, {}, out);
        const FrameCounts& counts = out.statistics.counts;
        times.parts.push_back({out.shaded.fill_seconds, out.shaded.shade_seconds, counts.samples, counts.records});
        if (times.parts.size() < settings.size() && !go_on(times)) break;
    }
    s.rendered = true;
    return times;
}

LightTime Sequence::time_light(std::int64_t frame) {
    SequenceState& s = state();
    const std::int64_t first = s.holds.find_first(frame);
    LightTime time;
    FrameOutput out;
    FramePlan plan;
    const SampleHits centers = s.look(first, s.needs_perception(), false, out, plan);
    s.finish_plan(centers.hits, out, plan);
    SampleOptions options = s.find_sample_options(first, plan);
    options.light_only = true;
    std::vector<MomentStatistics> filled;
    std::unique_ptr<CarriedLight> carried;
    if (options.light_lasts) carried = s.carry_light(first, plan, filled);
    s.leave_out(plan.effects);
    s.shade(first, centers, plan, carried.get(), options, {}, out);
    time.fill = out.shaded.fill_seconds;
    for (const MomentStatistics& moment : filled) time.moments += moment.seconds;
    s.rendered = true;
    return time;
}

}  // namespace aleph
