#include "render/shot_light.h"

#include <algorithm>

#include "render/measure.h"

namespace aleph {

ShotLight::ShotLight(KeyMoments moments, const RenderSettings& settings, bool still, bool unmoving, MomentSource source)
    : moments_(std::move(moments)),
      settings_(settings),
      still_(still),
      unmoving_(unmoving),
      source_(std::move(source)) {}

/// Where only the camera moves, a moment's light holds at all moments, so each needs its own view only.
std::vector<std::int64_t> ShotLight::list_views(std::int64_t moment) const {
    if (still_) return {moment};
    return find_moment_views(moments_, moment);
}

std::vector<IrradianceRecord> ShotLight::compute(std::int64_t moment, std::vector<MomentStatistics>& filled) {
    MomentStatistics statistics;
    statistics.frame = moment;
    StageClock clock;
    std::vector<std::shared_ptr<const KeyView>> views;
    for (const std::int64_t frame : list_views(moment)) {
        std::shared_ptr<const KeyView>& view = views_[frame];
        if (!view) {
            view = source_.look(frame);
            statistics.counts.rays += view->rays;
        }
        views.push_back(view);
    }
    std::vector<IrradianceRecord> records =
        compute_records(views, source_.light(moment), settings_, source_.cast, statistics.counts);
    clock.add_to(statistics.seconds);
    filled.push_back(statistics);
    return records;
}

std::shared_ptr<const MomentLight> ShotLight::find_or_fill(std::int64_t moment, std::vector<MomentStatistics>& filled) {
    std::shared_ptr<const MomentLight>& light = lights_[moment];
    if (light) return light;
    if (records_ && records_->contains(moment)) {
        light = std::make_shared<MomentLight>(make_moment_light(source_.pose(moment), records_->at(moment)));
        return light;
    }
    const std::vector<IrradianceRecord> records = compute(moment, filled);
    light = std::make_shared<MomentLight>(make_moment_light(views_.at(moment), records));
    if (records_) records_->emplace(moment, records);
    return light;
}

std::unique_ptr<CarriedLight> ShotLight::at(std::int64_t frame, std::vector<MomentStatistics>& filled) {
    const MomentPair pair = find_moments(moments_, unmoving_ ? moments_.range.first : frame);
    const bool between = pair.after != pair.before;
    const auto before = find_or_fill(pair.before, filled);
    const auto after = between ? find_or_fill(pair.after, filled) : nullptr;
    std::vector<std::int64_t> needed = list_views(pair.before);
    for (const std::int64_t view : list_views(pair.after)) needed.push_back(view);
    std::erase_if(views_, [&](const auto& entry) { return std::ranges::find(needed, entry.first) == needed.end(); });
    std::erase_if(lights_, [&](const auto& entry) { return entry.first != pair.before && entry.first != pair.after; });
    return std::make_unique<BlendedLight>(before, after, pair.weight, still_, settings_.shade_reach);
}

}  // namespace aleph
