#include "render/frame/frame_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "perception/sanitize.h"
#include "render/estimate/sight_line.h"

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
            const SampleHits centers = cast_centers(keyframe_.rays(), keyframe_.posed().view, &counts.primary);
            keyframe_.find_known_lights(centers, counts);
            find_nodes(needed, keyframe_, centers, counts);
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

OpenLens find_open_lens(const Shot& shot, std::int64_t frame, const FramePlan& plan) {
    OpenLens open;
    if (!plan.skips(Effect::depth_of_field)) open.lens = plan.lens;
    if (!plan.skips(Effect::motion_blur)) open.shutter = shot.open_shutter(frame);
    return open;
}

SampleScene open_scene(const OpenFrame& frame, double at) {
    const Shot& shot = frame.shot;
    EffectSet skipped = frame.scene.shading().skipped;
    // The plan knows the lights at the shutter's centre alone: at other times lamps are seen and cast shadows.
    for (const Effect effect : {Effect::direct_light, Effect::area_shadows})
        if (!shot.settings.effects.forbid.contains(effect)) skipped.remove(effect);
    const int camera = shot.camera(frame.number);
    frame.shutter.pose(at / shot.scene.film.frame_rate.per_second(), camera, shot.settings.picture.width,
                       shot.settings.picture.height);
    frame.shutter.prepare();
    frame.shutter.leave_out(skipped);
    std::uint64_t rays_cast = 0;
    frame.shutter.find_media_around(rays_cast);
    frame.shutter.take_known_lights(frame.scene);
    SampleScene sample = frame.shutter.sample_scene();
    sample.rays_cast = rays_cast;
    if (!frame.plan.skips(Effect::depth_of_field))
        sample.lens = find_lens(shot.scene, frame.shutter.posed().pose.cameras[camera]);
    return sample;
}

namespace {

/// The largest value within so many pixels in each direction.
Image<float> find_largest_around(const Image<float>& values, int reach) {
    Image<float> rows(values.width, values.height), largest(values.width, values.height);
    const auto spread = [&](const Image<float>& from, Image<float>& to, int step_x, int step_y) {
        parallel_pixels(to, 16, [&](int x, int y) {
            float most = 0.0f;
            for (int i = -reach; i <= reach; ++i) {
                const int nx = x + i * step_x, ny = y + i * step_y;
                if (nx >= 0 && ny >= 0 && nx < from.width && ny < from.height) most = std::max(most, from(nx, ny));
            }
            to(x, y) = most;
        });
    };
    spread(values, rows, 1, 0);
    spread(rows, largest, 0, 1);
    return largest;
}

/// Half of the longest way of a point between two times of a blurred estimate, and a pixel for the filter.
int find_blur_reach(const MotionField& motion, const ShutterInterval& shutter) {
    constexpr double most = 32.0;
    double longest = 0.0;
    for (const double length : motion.path_length.pixels) longest = std::max(longest, length);
    return 1 + static_cast<int>(std::ceil(std::min(most, 0.5 * longest * (shutter.close - shutter.open) / blur_looks)));
}

}  // namespace

Image<float> blur_frame_estimate(const OpenFrame& frame, const SampleHits& centers, const EstimateNodes* nodes,
                                 const MotionField& motion, Image<Rgb>& sharp, RayCounts& counts) {
    const Shot& shot = frame.shot;
    const FrameScene& scene = frame.scene;
    const OpenLens open = find_open_lens(shot, frame.number, frame.plan);
    if (!open.shutter && !(open.lens.radius > 0.0)) return {};
    const SharpEstimate estimate{.shading = scene.shading(),
                                 .view = scene.posed().view,
                                 .centers = centers,
                                 .picture = sharp,
                                 .nodes = nodes,
                                 .kind = shot.settings.guide.estimate,
                                 .exposure = shot.exposure,
                                 .lasts = !open.shutter || !frame.plan.input.shutter.light_changes};
    const auto look = [&](double place) -> SampleScene {
        if (open.shutter) return open_scene(frame, std::lerp(open.shutter->open, open.shutter->close, place));
        SampleScene still = scene.sample_scene();
        still.lens = open.lens;
        return still;
    };
    BlurredEstimate blurred = blur_estimate(estimate, look, counts);
    sanitize_estimate(blurred.picture);
    sharp = std::move(blurred.picture);
    if (!open.shutter) return {};
    return find_largest_around(blurred.swing, find_blur_reach(motion, *open.shutter));
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

/// The scene at one look through shutter and lens.
struct Look {
    const SharpEstimate& sharp;
    const SharpReader& reader;
    const NodeIrradiance* irradiance;
    const SampleScene& keyframe;

    /// Where a surface is in the frame, and in its picture.
    struct Still {
        std::optional<SurfacePoint> point;
        std::optional<glm::dvec2> at;
    };
    Still find_still(const Hit& hit, const SurfacePoint& point) const {
        if (!sharp.lasts) return {};
        Still still{carry_point(sharp.shading, hit, point), {}};
        if (still.point) still.at = reader.project(*still.point);
        return still;
    }

    /// Light of a surface in the sharp estimate, with exposure.
    std::optional<Rgb> read(const Hit& hit, const glm::vec3& direction) const {
        if (hit.instance == no_index) return std::nullopt;
        const Still still = find_still(hit, make_surface_point(keyframe.lighting.shading, hit, direction));
        if (!still.at) return std::nullopt;
        const float distance = sharp.view.orthographic ? 1.0f : hit.distance;
        const float footprint = distance / static_cast<float>(sharp.view.pixels_per_unit);
        return reader.read(*still.point, hit.instance, *still.at, footprint);
    }
};

/// The light of a line of sight of a look.
struct LookLight {
    const Look& look;
    RayTask& task;

    Rgb beyond(const SightLine& line) const { return estimate_surroundings(line, look.sharp.kind); }

    Rgb of(const SightLine& line) const {
        const PixelSurface& surface = line.surface();
        const Rgb radiance = estimate_radiance(line, task, look.sharp.kind);
        if (look.irradiance == nullptr) return radiance;
        DiffuseSurface diffuse = make_diffuse_surface(surface);
        if (!(diffuse.footprint > 0.0f)) return radiance;
        const Look::Still still = look.find_still(surface.hit, surface.point);
        if (still.point) {
            diffuse.position = still.point->position;
            diffuse.normal = still.point->normal;
        }
        const glm::dvec2 at = still.at.value_or(glm::dvec2(surface.x, surface.y));
        return radiance + diffuse.reflected * look.irradiance->at(diffuse, at);
    }
};

}  // namespace

BlurredEstimate blur_estimate(const SharpEstimate& sharp, const std::function<SampleScene(double place)>& look_at,
                              RayCounts& counts) {
    const int width = sharp.view.width, height = sharp.view.height;
    const SharpReader reader(sharp);
    std::optional<EstimateNodes> own_nodes;  // of one look, where the light does not last
    std::optional<NodeIrradiance> irradiance;
    if (sharp.nodes != nullptr) irradiance.emplace(*sharp.nodes);
    BlurredEstimate blurred{Image<Rgb>(width, height, Rgb(0.0f)), Image<float>(width, height, 0.0f)};
    Image<float> darkest(width, height, 1.0f);
    Image<Hit> hits(width, height);
    for (int i = 0; i < blur_looks; ++i) {
        const double time = (i + 0.5) / blur_looks;
        const SampleScene keyframe = look_at(time);
        // Fibonacci's lattice of 8 points: even over times and lens.
        const glm::vec2 u(std::fmod(time * 3.0, 1.0), std::fmod(time * 5.0, 1.0));
        const auto make_ray = [&](int x, int y) {
            if (!(keyframe.lens.radius > 0.0)) return make_camera_ray(keyframe.view, x + 0.5, y + 0.5);
            return make_lens_ray(keyframe.view, keyframe.lens, {x + 0.5, y + 0.5}, u);
        };
        cast_rays(keyframe.lighting.rays, make_ray, Blend::cutout, hits);
        counts.primary += hits.size() + keyframe.rays_cast;
        if (irradiance && !sharp.lasts) {
            const LightingContext& lighting = keyframe.lighting;
            const SampleHits centers = cast_centers(lighting.rays, keyframe.view, &counts.primary);
            irradiance.emplace(own_nodes.emplace(gather_estimate(lighting, keyframe.view, centers, nullptr, counts)));
        }
        const Look look{sharp, reader, irradiance ? &*irradiance : nullptr, keyframe};
        const auto exposure = static_cast<float>(sharp.exposure);
        const bool beside = keyframe.view.orthographic || keyframe.lens.radius > 0.0;
        const auto look_at_row = [&](int y, RayTask& task) {
            Tracer whole(keyframe.lighting.rays, Blend::whole);
            const LookLight light{look, task};
            for (int x = 0; x < width; ++x) {
                const SightStart start{keyframe.view, {x, y}, make_ray(x, y), hits(x, y), beside};
                std::optional<Rgb> found = look.read(start.hit, glm::vec3(start.ray.direction));
                if (!found) found = add_along_lines(light, keyframe.lighting, whole, start, task.counts) * exposure;
                const Rgb& seen = *found;
                blurred.picture(x, y) += seen * (1.0f / blur_looks);
                // `swing` holds the brightest until the last look. NaN counts as black.
                const float shown = std::min(1.0f, std::max(0.0f, luminance(seen)));
                darkest(x, y) = std::min(darkest(x, y), shown);
                blurred.swing(x, y) = std::max(blurred.swing(x, y), shown);
            }
        };
        cast_parallel(height, 4, keyframe.lighting.rays, counts, look_at_row, Blend::cutout);
    }
    for (std::size_t i = 0; i < darkest.size(); ++i) blurred.swing.pixels[i] -= darkest.pixels[i];
    return blurred;
}

}  // namespace aleph
