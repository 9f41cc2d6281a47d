#include "render/frame/frame_shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/pose/steady.h"

namespace aleph {

namespace {

constexpr int places_across = 16;                 // where light is looked at, in each direction of the picture
constexpr int most_spans = 8, least_samples = 8;  // of a pixel in each span: records for fewer do not pay

/// Inputs of the light of a shutter.
struct ShutterWork {
    SequenceState& s;
    std::int64_t frame;
    const PreparedFrame& prepared;
    const FrameRequest& request;
    const SampleOptions& options;
};

/// The scene while the shutter of a frame is open. Poses SequenceState::shutter.
class ShutterKeyLight {
  public:
    /// @param places  get their light at the shutter's centre once a pose differs from that
    /// @param counts  increased
    ShutterKeyLight(const ShutterWork& work, ShutterPlaces& places, FrameCounts& counts)
        : work_(work), places_(places), counts_(counts) {
        const RenderSettings& settings = work.prepared.plan.settings;
        if (work.options.limits != nullptr && settings.error > 0.0)
            tolerance_ = compute_sampling_tolerance(*work.options.limits, settings, work.s.shot.exposure);
    }

    std::shared_ptr<const KeyPose> pose(double at) {
        std::shared_ptr<const KeyPose>& known = poses_[at];
        if (known) return known;
        const auto key = std::make_shared<KeyPose>();
        SampleScene scene = open(at);
        work_.s.shutter.copy_to(*key);
        if (!is_same(places_.shading, key->shading)) {
            key->probed = probe_light(scene.lighting, places_.surfaces, counts_.rays);
            if (places_.probed.empty()) places_.probed = probe_center();
        }
        return known = key;
    }

    std::shared_ptr<const KeyframeLight> light(const KeyTime& key) {
        if (!key.pose) return nullptr;
        std::shared_ptr<const KeyframeLight>& known = lights_[key.at];
        if (!known) known = std::make_shared<KeyframeLight>(make_keyframe_light(key.pose, compute(key)));
        if (!base_) base_ = known;
        return known;
    }

  private:
    SampleScene open(double at) {
        SequenceState& s = work_.s;
        return open_scene({s.shot, work_.frame, work_.prepared.plan, s.here, s.shutter}, at);
    }

    ProbedLight probe_center() {
        const Shot& shot = work_.s.shot;
        const double center = shot.seconds(work_.frame) * shot.scene.film.frame_rate.per_second();
        return probe_light(open(center).lighting, places_.surfaces, counts_.rays);
    }

    KeyframeRecords compute(const KeyTime& key) {
        const auto& [s, frame, prepared, request, options] = work_;
        const RenderSettings& settings = prepared.plan.settings;
        const SampleScene scene = open(key.at);
        const auto view = std::make_shared<KeyView>();
        s.shutter.copy_to(*view);
        view->accuracy = prepared.out.limits.alpha;
        view->tolerance = tolerance_;
        const std::vector<std::shared_ptr<const KeyView>> views{view};
        const CastView cast = [&](const KeyView& seen, RayCounts& rays) {
            const SamplePlace place =
                make_sample_place(settings, scene.lens, work_.s.shot.blended, work_.s.shot.noise_key(work_.frame), 0);
            SampleHits hits = cast_sample(scene.lighting.rays, seen.posed.view, place, &rays.primary);
            if (work_.options.part != nullptr) forget_others(*work_.options.part, hits.hits);
            return hits;
        };
        std::optional<KeyframeLight> lasting;
        const auto accuracy = static_cast<float>(settings.cache.accuracy);
        if (base_) lasting = make_keyframe_light(base_->at, find_lasting(*base_, places_, *key.pose, accuracy));
        FrameCounts own;
        if (request.checkpoint != nullptr) request.checkpoint->begin_fill(fmt::format("shutter {}", key.at));
        KeyframeRecords records = compute_records({.lighting = scene.lighting,
                                                   .views = views,
                                                   .settings = settings,
                                                   .cast = cast,
                                                   .base = lasting ? &*lasting : nullptr,
                                                   .progress = request.progress,
                                                   .checkpoint = request.checkpoint},
                                                  own);
        counts_.rays += own.rays;
        counts_.records += own.records;
        return records;
    }

    const ShutterWork work_;
    ShutterPlaces& places_;
    FrameCounts& counts_;
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

/// Adds what is known of lights when the shutter opens and closes.
void add_lights_of_ends(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared,
                        const ShutterInterval& shutter, RayCounts& counts) {
    for (const double at : {shutter.open, shutter.close}) {
        open_scene({s.shot, frame, prepared.plan, s.here, s.shutter}, at);
        if (!is_same(s.here.shading(), s.shutter.shading()))
            s.here.add_known_lights(s.shutter, prepared.centers, counts);
    }
}

}  // namespace

FrameCounts find_shutter_light(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared,
                               const FrameRequest& request, bool carried, SampleOptions& options) {
    FrameCounts counts;
    const RenderSettings& settings = prepared.plan.settings;
    const std::optional<ShutterInterval> shutter = s.shot.open_shutter(frame);
    if (!shutter || settings.light.integrator != Integrator::cache) return counts;
    add_lights_of_ends(s, frame, prepared, *shutter, counts.rays);
    if (settings.light.bounces == 0 || settings.light.path_depth < 2 || !(settings.cache.accuracy > 0.0)) return counts;
    std::vector<double> jumps;
    if (!options.light_lasts) {
        const double rate = s.shot.scene.film.frame_rate.per_second();
        jumps = find_key_times(s.shot.scene, shutter->open / rate, shutter->close / rate);
        for (double& time : jumps) time *= rate;
    }
    ShutterPlaces places{choose_places(s, prepared), s.here.shading(), prepared.out.limits.alpha};
    ShutterKeyLight keys({s, frame, prepared, request, options}, places, counts);
    const int most = carried ? 0 : std::min(most_spans, settings.sampling.spp / least_samples);
    const ShutterTimes times = choose_times(
        *shutter, jumps, places, [&](double at) { return keys.pose(at); }, most);
    options.from_center = times.from_center;
    if (times.spans.empty()) return counts;
    keys.light(times.spans[times.spans.size() / 2].first);
    for (const KeySpan& span : times.spans) {
        options.spans.push_back(
            {span.first.at, span.last.at, keys.light(span.first), keys.light(span.last), span.changes});
    }
    return counts;
}

}  // namespace aleph
