#include "render/frame/frame_estimate.h"

#include <cmath>

#include "engine/base/pixel_loops.h"
#include "perception/sanitize.h"

namespace aleph {

Image<Rgb> estimate_scene(const Shot& shot, const FrameScene& scene, const SampleHits& centers,
                          const EstimateNodes* nodes, RayCounts& counts) {
    return compute_estimate(scene.lighting(), scene.posed().view, centers,
                            {shot.settings.guide.estimate, nodes, shot.exposure}, counts);
}

void EstimateLight::gather_around(std::int64_t frame, std::int64_t but, RayCounts& counts) {
    if (!shot_light_) return;
    const KeyframePair pair = shot_light_->keyframes_around(frame);
    for (const std::int64_t keyframe : {pair.before, pair.after}) {
        if (kept_.find(keyframe)) continue;
        for (const std::int64_t needed : {shot_light_->find_base(keyframe), keyframe}) {
            if (needed == keyframe && keyframe == but) continue;
            if (kept_.find(needed)) continue;
            keyframe_.pose(needed);
            keyframe_.prepare();
            find_nodes(needed, keyframe_, cast_centers(keyframe_.rays(), keyframe_.posed().view, &counts.primary),
                       counts);
        }
    }
}

/// Null if there are no lighting keyframes.
std::unique_ptr<CarriedEstimate> EstimateLight::carry(std::int64_t frame) const {
    if (!shot_light_) return nullptr;
    const KeyframePair pair = shot_light_->keyframes_around(frame);
    const auto before = kept_.find(pair.before), after = kept_.find(pair.after);
    if (!before || !after) return nullptr;
    return std::make_unique<BlendedEstimate>(before, after, pair.weight);
}

EstimateNodes EstimateLight::gather_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers,
                                          RayCounts& counts) const {
    return gather_estimate(scene.lighting(), scene.posed().view, centers, carry(frame).get(), counts);
}

EstimateNodes EstimateLight::find_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers,
                                        RayCounts& counts) {
    const bool is_keyframe = shot_light_ && shot_light_->keyframes_around(frame).before == frame;
    if (!is_keyframe) return gather_nodes(frame, scene, centers, counts);
    if (const auto kept = kept_.find(frame)) return kept->nodes;
    std::optional<BlendedEstimate> carried;
    if (const std::int64_t base = shot_light_->find_base(frame); base != frame) {
        const auto kept = kept_.find(base);
        carried.emplace(kept, kept, 0.0);
    }
    const auto keyframe = std::make_shared<EstimateKeyframe>(
        frame, gather_estimate(scene.lighting(), scene.posed().view, centers, carried ? &*carried : nullptr, counts));
    scene.copy_to(*keyframe);
    kept_.keep(keyframe);
    return keyframe->nodes;
}

OpenLens find_open_lens(const Shot& shot, std::int64_t frame, const FrameScene& scene, const FramePlan& plan) {
    OpenLens open;
    if (!plan.skips(Effect::depth_of_field))
        open.lens = find_lens(shot.scene, scene.posed().pose.cameras[shot.camera(frame)]);
    if (!plan.skips(Effect::motion_blur)) open.shutter = shot.open_shutter(frame);
    return open;
}

SampleScene open_scene(const Shot& shot, std::int64_t frame, double at, const FrameScene& scene, FrameScene& shutter) {
    EffectSet skipped = scene.shading().skipped;
    // The plan knows the lights at the shutter's centre alone: at other times lamps are seen and cast shadows.
    for (const Effect effect : {Effect::direct_light, Effect::area_shadows})
        if (!shot.settings.effects.forbid.contains(effect)) skipped.remove(effect);
    shutter.pose(at / shot.scene.film.frame_rate.per_second(), shot.camera(frame), shot.settings.picture.width,
                 shot.settings.picture.height);
    shutter.prepare();
    shutter.leave_out(skipped);
    shutter.take_media_around(scene);
    return shutter.sample_scene();
}

void blur_frame_estimate(const OpenFrame& frame, const SampleHits& centers, const EstimateNodes* nodes,
                         Image<Rgb>& sharp, RayCounts& counts) {
    const Shot& shot = frame.shot;
    const FrameScene& scene = frame.scene;
    const OpenLens open = find_open_lens(shot, frame.number, scene, frame.plan);
    if (!open.shutter && !(open.lens.radius > 0.0)) return;
    const SharpEstimate estimate{scene.shading(), scene.posed().view,           centers,      sharp,
                                 nodes,           shot.settings.guide.estimate, shot.exposure};
    const auto look = [&](double place) -> SampleScene {
        if (!open.shutter) return scene.sample_scene();
        const double at = open.shutter->open + (open.shutter->close - open.shutter->open) * place;
        return open_scene(shot, frame.number, at, scene, frame.shutter);
    };
    Image<Rgb> blurred = blur_estimate(estimate, open.lens, look, counts);
    sanitize_estimate(blurred);
    sharp = std::move(blurred);
}

namespace {

constexpr float least_weight = 0.25f;  // of the pixels around a place that show its surface

/// The sharp estimate, read where it shows a given point.
class SharpReader {
  public:
    explicit SharpReader(const SharpEstimate& sharp)
        : sharp_(sharp), positions_(sharp.view.width, sharp.view.height, glm::vec3(0.0f)) {
        parallel_pixels(positions_, 16, [&](int x, int y) { place(x, y); });
    }

    /// Where a point lies in the picture, in pixels: 0 is the centre of the first one.
    std::optional<glm::dvec2> project(const SurfacePoint& point) const {
        const CameraView& view = sharp_.view;
        const glm::dvec3 seen = to_camera(view, sharp_.shading.anchor + glm::dvec3(point.position));
        if (!(-seen.z > view.near_plane)) return std::nullopt;
        const glm::dvec2 at = project_camera_point(view, seen) - 0.5;
        const bool inside = at.x > -1.0 && at.y > -1.0 && at.x < view.width && at.y < view.height;
        return inside ? std::optional(at) : std::nullopt;
    }

    /// From the four pixels around a place, of those that show the point's surface.
    /// @param at  project of the point
    /// @param footprint  size of a pixel there, m
    std::optional<Rgb> read(const SurfacePoint& point, int instance, const glm::dvec2& at, float footprint) const {
        const int left = static_cast<int>(std::floor(at.x)), top = static_cast<int>(std::floor(at.y));
        const glm::vec2 part(at.x - left, at.y - top);
        Rgb sum(0.0f);
        float weights = 0.0f;
        for (int i = 0; i < 4; ++i) {
            const int x = left + i % 2, y = top + i / 2;
            if (!shows(point, instance, footprint, x, y)) continue;
            const float weight = (i % 2 == 1 ? part.x : 1.0f - part.x) * (i / 2 == 1 ? part.y : 1.0f - part.y);
            sum += sharp_.picture(x, y) * weight;
            weights += weight;
        }
        return weights >= least_weight ? std::optional(sum / weights) : std::nullopt;
    }

  private:
    void place(int x, int y) {
        const Hit& hit = sharp_.centers.hits(x, y);
        if (hit.instance == no_index) return;
        const glm::vec3 direction(make_sample_ray(sharp_.view, sharp_.centers.place, x, y).direction);
        positions_(x, y) = make_surface_point(sharp_.shading, hit, direction).position;
    }

    bool shows(const SurfacePoint& point, int instance, float footprint, int x, int y) const {
        if (x < 0 || y < 0 || x >= sharp_.view.width || y >= sharp_.view.height) return false;
        if (sharp_.centers.hits(x, y).instance != instance) return false;
        return std::abs(glm::dot(point.geometric, positions_(x, y) - point.position)) <= footprint;
    }

    const SharpEstimate& sharp_;
    Image<glm::vec3> positions_;
};

/// One look through shutter and lens.
struct Look {
    const SharpEstimate& sharp;
    const SharpReader& reader;
    const NodeIrradiance* irradiance;
    const SampleScene& keyframe;

    /// Radiance without exposure of a surface that the sharp estimate does not show.
    Rgb shade(RayTask& task, const PixelSurface& surface, const std::optional<SurfacePoint>& still,
              const glm::dvec2& pixel) const {
        Rgb radiance = estimate_radiance(keyframe.lighting, task, surface, sharp.kind);
        if (irradiance == nullptr) return radiance;
        DiffuseSurface diffuse = make_diffuse_surface(surface);
        if (!(diffuse.footprint > 0.0f)) return radiance;
        if (still) {
            diffuse.position = still->position;
            diffuse.normal = still->normal;
        }
        return radiance + diffuse.reflected * irradiance->at(diffuse, pixel);
    }

    Rgb find(RayTask& task, const Hit& hit, const glm::vec3& direction, int x, int y) const {
        const auto exposure = static_cast<float>(sharp.exposure);
        if (hit.instance == no_index) {
            if (sharp.kind == EstimateKind::flat) return Rgb(exposure);
            return environment_radiance(keyframe.lighting.shading, direction) * exposure;
        }
        const SurfacePoint point = make_surface_point(keyframe.lighting.shading, hit, direction);
        const std::optional<SurfacePoint> still = carry_point(sharp.shading, hit, point);
        const std::optional<glm::dvec2> at = still ? reader.project(*still) : std::nullopt;
        if (at) {
            const float distance = sharp.view.orthographic ? 1.0f : hit.distance;
            const float footprint = distance / static_cast<float>(sharp.view.pixels_per_unit);
            if (const auto known = reader.read(*still, hit.instance, *at, footprint)) return *known;
        }
        const PixelSurface surface =
            make_pixel_surface(keyframe.lighting.shading, keyframe.view, SamplePlace{}, hit, direction, {x, y});
        return shade(task, surface, still, at.value_or(glm::dvec2(x, y))) * exposure;
    }
};

}  // namespace

Image<Rgb> blur_estimate(const SharpEstimate& sharp, const Lens& lens,
                         const std::function<SampleScene(double place)>& look_at, RayCounts& counts) {
    const int width = sharp.view.width, height = sharp.view.height;
    const SharpReader reader(sharp);
    const std::optional<NodeIrradiance> irradiance =
        sharp.nodes != nullptr ? std::optional<NodeIrradiance>(*sharp.nodes) : std::nullopt;
    Image<Rgb> blurred(width, height, Rgb(0.0f));
    Image<Hit> hits(width, height);
    for (int i = 0; i < blur_looks; ++i) {
        const double time = (i + 0.5) / blur_looks;
        const SampleScene keyframe = look_at(time);
        // Fibonacci's lattice of 8 points: even over times and lens.
        const glm::vec2 u(std::fmod(time * 3.0, 1.0), std::fmod(time * 5.0, 1.0));
        const auto make_ray = [&](int x, int y) {
            if (!(lens.radius > 0.0)) return make_camera_ray(keyframe.view, x + 0.5, y + 0.5);
            return make_lens_ray(keyframe.view, lens, {x + 0.5, y + 0.5}, u);
        };
        cast_rays(keyframe.lighting.rays, make_ray, Blend::cutout, hits);
        counts.primary += hits.size();
        const Look look{sharp, reader, irradiance ? &*irradiance : nullptr, keyframe};
        const auto look_at_row = [&](int y, RayTask& task) {
            for (int x = 0; x < width; ++x) {
                const glm::vec3 direction(make_ray(x, y).direction);
                blurred(x, y) += look.find(task, hits(x, y), direction, x, y) * (1.0f / blur_looks);
            }
        };
        cast_parallel(height, 4, keyframe.lighting.rays, counts, look_at_row, Blend::cutout);
    }
    return blurred;
}

}  // namespace aleph
