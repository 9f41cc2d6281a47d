#include "render/frame/sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/load/validate_scene.h"
#include "render/frame/sequence_state.h"
#include "render/guide/accuracy_map.h"
#include "render/settings/measure.h"

namespace aleph {

namespace {

/// The picture that the exposure is measured from: 160 columns, and fewer where it would have more than 640 rows.
/// Without that bound a picture of 1x8192 would be measured from 1.3 million rows.
glm::ivec2 find_measured_size(const PictureSettings& picture) {
    constexpr std::int64_t most_columns = 160, most_rows = 640;
    const std::int64_t rows = most_columns * picture.height / picture.width;
    if (rows <= most_rows) return {most_columns, std::max<std::int64_t>(1, rows)};
    return {std::max<std::int64_t>(1, most_rows * picture.width / picture.height), most_rows};
}

/// The exposure that the scene has with all of its effects, so that pictures without some of them can be compared.
double find_full_exposure(const Scene& scene, RenderSettings settings, const std::string& camera) {
    settings.effects.forbid = {};
    return Sequence(scene, settings, camera).exposure();
}

/// Returns whether points of a cage's surface are the same points of another's, at any level.
bool has_same_surface(const Cage& a, const Cage& b) {
    return a.scheme == b.scheme && a.boundary == b.boundary && a.faces == b.faces && a.creases == b.creases &&
           a.corners == b.corners;
}

/// Returns whether triangles of one scene's meshes are found in the other's.
bool has_same_triangles(const Scene& a, const Scene& b) {
    const auto same = [&](const Mesh& m, const Mesh& n) {
        const int cage = m.subdivision.cage, other = n.subdivision.cage;
        if (cage == no_index || other == no_index) return cage == other && m.triangles == n.triangles;
        return m.subdivision.part == n.subdivision.part && has_same_surface(a.cages[cage], b.cages[other]);
    };
    return std::ranges::equal(a.meshes, b.meshes, same);
}

/// From a small quick estimate of the first frame; where that is black, of the first of some later ones that is not.
/// Nothing where all of them are.
std::optional<double> find_exposure(const Shot& shot, FrameScene& scene) {
    const glm::ivec2 size = find_measured_size(shot.settings.picture);
    const auto [first, last] = shot.range;
    const std::int64_t between = std::max<std::int64_t>(1, (last - first) / 8);
    for (std::int64_t frame = first; frame <= last; frame += between) {
        scene.pose(shot.scene.film.frame_rate.seconds_of(frame), shot.camera(frame), size.x, size.y);
        scene.prepare();
        RayCounts counts;
        const SampleHits centers = cast_centers(scene.rays(), scene.posed().view, &counts.primary);
        scene.find_known_lights(centers, counts);
        const std::optional<double> exposure = compute_exposure(
            compute_estimate(scene.lighting(), scene.posed().view, centers, {.exposure = shot.exposure}, counts));
        if (exposure) return exposure;
    }
    return std::nullopt;
}

}  // namespace

Sequence::Sequence(Scene scene, const RenderSettings& settings, const std::string& camera) : camera_(camera) {
    validate(settings);
    validate(scene);
    const std::vector<CameraShot> shots = list_camera_shots(scene, camera);
    if (!settings.effects.forbid.empty()) {
        if (!scene.film.exposure) scene.film.exposure = find_full_exposure(scene, settings, camera);
        remove_forbidden(settings.effects.forbid, scene);
    }
    state_ = std::make_unique<SequenceState>(std::move(scene), without_forbidden(settings), shots);
    Shot& shot = state_->shot;
    const std::optional<double> exposure =
        shot.scene.film.exposure ? shot.scene.film.exposure : find_exposure(shot, state_->here);
    shot.is_dark = !exposure;
    shot.exposure = exposure.value_or(1.0);
}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;

SequenceState& Sequence::state() const {
    if (state_ == nullptr) throw InputError("", "Sequence", "this sequence has been moved from");
    return *state_;
}

SequenceState& Sequence::state_for(std::int64_t frame) const {
    if (!is_frame(frame)) throw InputError("", "frame", fmt::format("{}: frames lie within 9e15 of 0", frame));
    return state();
}

const Scene& Sequence::scene() const {
    return state().shot.scene;
}
double Sequence::exposure() const {
    return state().shot.exposure;
}

bool Sequence::is_dark() const {
    return state().shot.is_dark;
}

FrameRange Sequence::range() const {
    return state().shot.range;
}

FrameOutput Sequence::render(std::int64_t frame, const FrameRequest& request) {
    SequenceState& s = state_for(frame);
    const PictureSettings& picture = s.shot.settings.picture;
    if (request.window && !lies_within(*request.window, picture.width, picture.height))
        throw InputError("", "window", "it is empty or not within the picture");
    // The first frame after an edit has a motion that no other frame has.
    const bool is_edited = s.motion.is_edited();
    const std::int64_t first = is_edited ? frame : s.static_spans.find_first(frame);
    std::optional<FrameOutput> out = s.static_frame.copy(first, request);
    if (!out) {
        s.static_frame.drop();
        out = render_frame(s, first, request);
        const bool is_needed = !is_edited && (frame > first || s.static_spans.find_first(frame + 1) == first);
        if (is_needed) s.static_frame.keep(first, request, *out);
    }
    out->statistics.frame = frame;
    if (first != frame) {
        out->statistics.copy_of = first;
        if (!out->backward.validity.empty()) out->backward = out->motion;  // nothing has moved since the frame before
    }
    return std::move(*out);
}

EffectsPlan Sequence::plan(std::int64_t frame) {
    SequenceState& s = state_for(frame);
    const std::int64_t first = s.motion.is_edited() ? frame : s.static_spans.find_first(frame);
    return s.prepare(first, s.shot.needs_perception(), false).plan.effects;
}

void Sequence::edit(const std::function<void(Scene&)>& change) {
    SequenceState& old = state();
    Scene scene = old.shot.given_scene();
    change(scene);
    validate(scene);
    remove_forbidden(old.shot.settings.effects.forbid, scene);
    const std::vector<CameraShot> shots = list_camera_shots(scene, camera_);
    auto made = std::make_unique<SequenceState>(std::move(scene), old.shot.settings, shots);
    made->shot.exposure = made->shot.scene.film.exposure.value_or(old.shot.exposure);
    std::optional<FrameBeforeEdit> before = old.motion.end_edited();
    if (old.rendered) {
        old.here.pose(*old.rendered);  // plans and parts of other frames have moved it
        before = FrameBeforeEdit{*old.rendered, old.here.posed()};
    }
    if (before) {
        before->same_triangles = before->same_triangles && has_same_triangles(old.shot.scene, made->shot.scene);
        made->motion.begin_edited(std::move(*before));
    }
    state_ = std::move(made);
}

void Sequence::load_light(const std::filesystem::path& path) {
    SequenceState& s = state();
    if (!s.shot_light) {
        throw InputError(
            path.string(), "",
            "a cache file needs lighting keyframes: the integrator cache, an accuracy and a light_step above 0 (beside "
            "error, set light_step too)");
    }
    if (s.shot.settings.guide.own_adapter != nullptr)
        throw InputError(path.string(), "",
                         "light cannot be kept with an adapter of a program's own: no file tells it");
    s.shot_light->use({path, make_cache_fingerprint(s.shot.scene, s.shot.settings, s.shot.shots)});
}

void Sequence::save_light() {
    SequenceState& s = state();
    ALEPH_CHECK(s.shot_light && s.shot_light->store() != nullptr, "save_light before load_light");
    s.shot_light->store()->save();
}

PartTimes Sequence::time_part(std::int64_t frame, const PicturePart& part, std::span<const RenderSettings> settings,
                              const std::function<bool(const PartTimes&)>& go_on) {
    SequenceState& s = state_for(frame);
    PartTimes times;
    times.frame = s.static_spans.find_first(frame);
    StageClock clock;
    PreparedFrame prepared = s.prepare(times.frame, s.shot.needs_perception(), false);
    clock.add_to(times.before);
    s.here.leave_out(prepared.plan.effects);
    FrameOutput& out = prepared.out;
    const int bounces = prepared.plan.settings.light.bounces;
    for (const RenderSettings& chosen : settings) {
        prepared.plan.settings = chosen;
        prepared.plan.settings.light.bounces = bounces;
        if (s.shot.needs_perception()) out.limits.alpha = compute_accuracy_map(out.perception.aleph, chosen);
        out.statistics.counts = {};
        SampleOptions options = find_sample_options(s, times.frame, prepared.plan);
        options.part = &part;
        shade_prepared(s, times.frame, prepared, nullptr, options);
        const FrameCounts& counts = out.statistics.counts;
        times.parts.push_back({out.shaded.fill_seconds, out.shaded.shade_seconds, counts.samples, counts.records});
        if (times.parts.size() < settings.size() && !go_on(times)) break;
    }
    return times;
}

LightTime Sequence::time_light(std::int64_t frame) {
    SequenceState& s = state_for(frame);
    const std::int64_t first = s.static_spans.find_first(frame);
    PreparedFrame prepared = s.prepare(first, s.shot.needs_perception(), false);
    SampleOptions options = find_sample_options(s, first, prepared.plan);
    options.light_only = true;
    std::vector<KeyframeStatistics> filled;
    std::unique_ptr<CarriedLight> carried;
    if (options.light_lasts) carried = find_carried_light(s, first, prepared.plan, filled);
    s.here.leave_out(prepared.plan.effects);
    shade_prepared(s, first, prepared, carried.get(), options);
    LightTime time{.fill = prepared.out.shaded.fill_seconds};
    for (const KeyframeStatistics& keyframe : filled) time.keyframes += keyframe.seconds;
    return time;
}

std::vector<Image<Rgb>> Sequence::render_part(std::int64_t frame, const PicturePart& part,
                                              std::span<const PartSamples> pictures, const FrameProgress& progress) {
    SequenceState& s = state_for(frame);
    ALEPH_CHECK(s.shot.settings.light.integrator == Integrator::path && !s.shot.needs_perception(), "a part by paths");
    const std::int64_t first = s.static_spans.find_first(frame);
    PreparedFrame prepared = s.prepare(first, false, false);
    s.here.leave_out(prepared.plan.effects);
    std::vector<Image<Rgb>> made;
    for (const PartSamples& samples : pictures) {
        prepared.plan.settings.seed = samples.seed;
        prepared.plan.settings.sampling.spp = samples.spp;
        SampleOptions options = find_sample_options(s, first, prepared.plan);
        options.part = &part;
        options.part_picture = true;
        shade_prepared(s, first, prepared, nullptr, options, {.progress = progress});
        made.push_back(std::move(prepared.out.shaded.color));
    }
    return made;
}

FrameOutput Sequence::find_motion(std::int64_t frame) {
    SequenceState& s = state_for(frame);
    ALEPH_CHECK(s.shot.settings.guide.motion == MotionSource::model && !s.motion.is_edited(),
                "motion of the scene's tracks");
    PreparedFrame prepared = prepare_frame(
        s, s.here, {.frame = s.static_spans.find_first(frame), .perceive = true, .maps = true, .motion_only = true});
    prepared.out.hits = std::move(prepared.centers.hits);
    return std::move(prepared.out);
}

}  // namespace aleph
