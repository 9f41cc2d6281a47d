#include "render/frame/frame_shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/pose/steady.h"

namespace aleph {

namespace {

constexpr int places_across = 16;                 // where light is looked at, in each direction of the picture
constexpr int most_spans = 8, least_samples = 8;  // of a pixel in each span: records for fewer do not pay

/// The scene while the shutter of a frame is open. Poses SequenceState::shutter.
class ShutterKeyLight {
  public:
    ShutterKeyLight(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared, const SampleOptions& options,
                    const FrameRequest& request)
        : s_(s), frame_(frame), prepared_(prepared), options_(options), request_(request) {
        if (options.limits != nullptr && prepared.plan.settings.error > 0.0)
            tolerance_ = compute_sampling_tolerance(*options.limits, prepared.plan.settings, s.shot.exposure);
    }

    std::shared_ptr<const KeyPose> pose(double at) {
        std::shared_ptr<const KeyPose>& known = poses_[at];
        if (known) return known;
        open(at);
        const auto key = std::make_shared<KeyPose>();
        s_.shutter.copy_to(*key);
        return known = key;
    }

    std::shared_ptr<const KeyframeLight> light(const KeyTime& key, FrameCounts& counts) {
        if (!key.pose) return nullptr;
        std::shared_ptr<const KeyframeLight>& known = lights_[key.at];
        if (!known) known = std::make_shared<KeyframeLight>(make_keyframe_light(key.pose, compute(key, counts)));
        if (!base_) base_ = known;
        return known;
    }

  private:
    SampleScene open(double at) { return open_scene({s_.shot, frame_, prepared_.plan, s_.here, s_.shutter}, at); }

    KeyframeRecords compute(const KeyTime& key, FrameCounts& counts) {
        const SampleScene scene = open(key.at);
        const auto view = std::make_shared<KeyView>();
        s_.shutter.copy_to(*view);
        view->accuracy = prepared_.out.limits.alpha;
        view->tolerance = tolerance_;
        const std::vector<std::shared_ptr<const KeyView>> views{view};
        const CastView cast = [&](const KeyView& seen, RayCounts& rays) {
            const SamplePlace place =
                make_sample_place(prepared_.plan.settings, scene.lens, s_.shot.blended, s_.shot.noise_key(frame_), 0);
            SampleHits hits = cast_sample(scene.lighting.rays, seen.posed.view, place, &rays.primary);
            if (options_.part != nullptr) forget_others(*options_.part, hits.hits);
            return hits;
        };
        std::optional<KeyframeLight> lasting;
        const auto accuracy = static_cast<float>(prepared_.plan.settings.cache.accuracy);
        if (base_) lasting = make_keyframe_light(base_->at, find_lasting(*base_, *key.pose, accuracy));
        FrameCounts own;
        if (request_.checkpoint != nullptr) request_.checkpoint->begin_fill(fmt::format("shutter {}", key.at));
        KeyframeRecords records = compute_records({.lighting = scene.lighting,
                                                   .views = views,
                                                   .settings = prepared_.plan.settings,
                                                   .cast = cast,
                                                   .base = lasting ? &*lasting : nullptr,
                                                   .progress = request_.progress,
                                                   .checkpoint = request_.checkpoint},
                                                  own);
        counts.rays += own.rays;
        counts.records += own.records;
        return records;
    }

    SequenceState& s_;
    const std::int64_t frame_;
    const PreparedFrame& prepared_;
    const SampleOptions& options_;
    const FrameRequest& request_;
    Image<float> tolerance_;
    std::map<double, std::shared_ptr<const KeyPose>> poses_;
    std::map<double, std::shared_ptr<const KeyframeLight>> lights_;
    std::shared_ptr<const KeyframeLight> base_;  ///< computed first: what lasts of it is not computed again
};

/// Surfaces in rows and columns of the picture that scatter diffuse light.
std::vector<PixelSurface> choose_places(const SequenceState& s, const PreparedFrame& prepared) {
    const CameraView& view = prepared.out.view;
    std::vector<PixelSurface> places;
    for (int i = 0; i < places_across * places_across; ++i) {
        const int x = (2 * (i % places_across) + 1) * view.width / (2 * places_across),
                  y = (2 * (i / places_across) + 1) * view.height / (2 * places_across);
        if (prepared.centers.hits(x, y).instance == no_index) continue;
        PixelSurface surface = make_pixel_surface(s.here.shading(), view, prepared.centers, x, y);
        if (surface.material.has_diffuse()) places.push_back(std::move(surface));
    }
    return places;
}

}  // namespace

std::vector<ShutterSpan> find_shutter_spans(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared,
                                            const SampleOptions& options, const FrameRequest& request,
                                            FrameCounts& counts) {
    const RenderSettings& settings = prepared.plan.settings;
    const std::optional<ShutterInterval> shutter = s.shot.open_shutter(frame);
    if (!shutter || settings.light.integrator != Integrator::cache || settings.light.bounces == 0 ||
        settings.light.path_depth < 2 || !(settings.cache.accuracy > 0.0))
        return {};
    std::vector<double> jumps;
    if (!options.light_lasts) {
        const double rate = s.shot.scene.film.frame_rate.per_second();
        jumps = find_key_times(s.shot.scene, shutter->open / rate, shutter->close / rate);
        for (double& time : jumps) time *= rate;
    }
    ShutterKeyLight keys(s, frame, prepared, options, request);
    const auto pose = [&](double at) { return keys.pose(at); };
    const ShutterPlaces places{choose_places(s, prepared), s.here.shading(), prepared.out.limits.alpha};
    const int most = std::min(most_spans, settings.sampling.spp / least_samples);
    const auto chosen = choose_spans(*shutter, jumps, places, pose, most);
    if (!chosen.empty()) keys.light(chosen[chosen.size() / 2].first, counts);
    std::vector<ShutterSpan> spans;
    for (const auto& [first, last] : chosen) {
        spans.push_back({first.at, last.at, keys.light(first, counts), keys.light(last, counts)});
    }
    return spans;
}

}  // namespace aleph
