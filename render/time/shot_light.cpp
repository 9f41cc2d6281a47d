#include "render/time/shot_light.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/settings/measure.h"

namespace aleph {

namespace {

/// The half of a pair that holds a frame; the middle itself at the middle.
KeyframePair find_half(const KeyframePair& pair, std::int64_t middle, std::int64_t frame) {
    if (frame == middle) return {middle, middle, 0.0};
    const std::int64_t before = frame < middle ? pair.before : middle, after = frame < middle ? middle : pair.after;
    return {before, after, static_cast<double>(frame - before) / static_cast<double>(after - before)};
}

}  // namespace

/// Where only the camera moves, a keyframe's light holds at all keyframes, so each needs its own view only.
std::vector<std::int64_t> ShotLight::list_views(std::int64_t keyframe) const {
    if (still_) return {keyframe};
    return find_keyframe_views(keyframes_, keyframe);
}

std::int64_t ShotLight::find_base(std::int64_t keyframe) const {
    return still_ && !unmoving_ ? find_base_keyframe(keyframes_, keyframe) : keyframe;
}

KeyframeRecords ShotLight::compute(std::int64_t keyframe, const std::vector<std::int64_t>& frames,
                                   const CarriedLight* carried, const KeyframeLight* base, const KeyframeWork& work) {
    KeyframeStatistics statistics;
    statistics.frame = keyframe;
    StageClock clock;
    std::vector<std::shared_ptr<const KeyView>> views;
    for (const std::int64_t frame : frames) {
        std::shared_ptr<const KeyView>& view = views_[frame];
        if (!view) {
            view = source_.look(frame);
            statistics.counts.rays += view->rays;
            if (work.progress) work.progress(0.0, "fill");
        }
        views.push_back(view);
    }
    const LightingContext lighting = source_.light(keyframe, statistics.counts.rays);
    if (work.checkpoint != nullptr) work.checkpoint->begin_fill(fmt::format("keyframe {}", keyframe));
    const KeyframeInput input{keyframe, lighting, views,  settings_,     source_.cast,
                              carried,  base,     still_, work.progress, work.checkpoint};
    KeyframeRecords records = compute_records(input, statistics.counts);
    clock.add_to(statistics.seconds);
    work.filled.push_back(statistics);
    return records;
}

void ShotLight::prepare(std::int64_t keyframe, const std::vector<std::int64_t>& views, const CarriedLight* carried,
                        const KeyframeWork& work) {
    std::shared_ptr<const KeyframeLight>& light = lights_[keyframe];
    if (light) return;
    std::optional<KeyframeRecords> records;
    if (store_) records = store_->find(keyframe);
    const std::int64_t base = find_base(keyframe);
    if (!records) {
        if (base != keyframe) prepare(base, list_views(base), nullptr, work);
        records = compute(keyframe, views, carried, base == keyframe ? nullptr : lights_.at(base).get(), work);
        if (store_) store_->keep(keyframe, *records);
    }
    light = std::make_shared<KeyframeLight>(make_keyframe_light(source_.pose(keyframe), *records));
}

std::unique_ptr<BlendedLight> ShotLight::blend(const KeyframePair& pair) const {
    const auto after = pair.after == pair.before ? nullptr : lights_.at(pair.after);
    return std::make_unique<BlendedLight>(lights_.at(pair.before), after, pair.weight,
                                          still_ ? BetweenKeys::still : BetweenKeys::anything);
}

std::unique_ptr<CarriedLight> ShotLight::at(std::int64_t frame, const KeyframeWork& work) {
    const KeyframePair pair = keyframes_around(frame);
    const std::vector<std::int64_t> ends{pair.before, pair.after};
    std::vector<std::int64_t> views, lights = ends;
    for (const std::int64_t keyframe : ends) {
        const std::vector<std::int64_t> own = list_views(keyframe);
        prepare(keyframe, own, nullptr, work);
        views.insert(views.end(), own.begin(), own.end());
        lights.push_back(find_base(keyframe));
    }
    std::unique_ptr<BlendedLight> light = blend(pair);
    const std::int64_t middle = pair.before + (pair.after - pair.before) / 2;
    if (!still_ && middle != pair.before) {
        const std::unique_ptr<BlendedLight> at_middle =
            blend({pair.before, pair.after, find_keyframes(keyframes_, middle).weight});
        prepare(middle, ends, at_middle.get(), work);
        lights.push_back(middle);
        light->set_finer(blend(find_half(pair, middle, frame)));
    }
    const auto unneeded = [](const auto& needed) {
        return [&](const auto& entry) { return std::ranges::find(needed, entry.first) == needed.end(); };
    };
    std::erase_if(views_, unneeded(views));
    std::erase_if(lights_, unneeded(lights));
    return light;
}

std::vector<const ShadingScene*> ShotLight::scenes_around(std::int64_t frame) const {
    const KeyframePair pair = keyframes_around(frame);
    std::vector<const ShadingScene*> scenes;
    if (still_ || pair.before == frame || pair.after == frame) return scenes;
    for (const auto& [keyframe, light] : lights_) {
        if (keyframe >= pair.before && keyframe <= pair.after) scenes.push_back(&light->at->shading);
    }
    return scenes;
}

}  // namespace aleph
