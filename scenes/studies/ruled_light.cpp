#include "scenes/studies/ruled_light.h"

#include <algorithm>

#include "render/cache/cache_fill.h"
#include "render/cache/gather_at.h"

namespace aleph {

namespace {

constexpr int first_stride = 64;           // pixels
constexpr float least_pixels = 0.7f;       // of the reach, as in the renderer's cache
constexpr float most_of_scene = 0.25f;     // of the reach, over the scene's radius
constexpr double beyond_everything = 1e3;  // scene radii: where a ray that meets nothing ends

class RuledCache {
  public:
    RuledCache(const IndirectContext& context, RadiusRule rule, double accuracy)
        : context_(context), rule_(rule), accuracy_(static_cast<float>(accuracy)) {}

    bool covers(const FillPoint& point) const {
        return std::ranges::any_of(records_, [&](const RuledRecord& record) {
            return ruled_error(rule_, record, point.position, point.normal) < 1.0f;
        });
    }

    /// Weighted mean; nothing where no record may be used.
    std::optional<Rgb> interpolate(const FillPoint& point) const {
        Rgb sum(0.0f);
        float total = 0.0f;
        for (const RuledRecord& record : records_) {
            const float error = ruled_error(rule_, record, point.position, point.normal);
            if (!(error < 1.0f)) continue;
            sum += extrapolate(record.value, point.position, point.normal) * (1.0f - error);
            total += 1.0f - error;
        }
        if (!(total > 0.0f)) return std::nullopt;
        return sum / total;
    }

    /// Gathers at a surface and adds its record. @return false where the gather is not finite
    bool add(const PixelSurface& surface, const FillPoint& point, RayTask& task) {
        std::vector<DirectSample> direct;
        const HemisphereStrata strata = choose_strata(context_.settings.gather);
        const IrradianceSample sample = gather_at(context_, task, surface, scratch_, context_.settings.gather, &direct);
        if (context_.direct != nullptr) context_.direct->insert(direct);
        RuleInput input{.rule = rule_,
                        .accuracy = accuracy_,
                        .area = double{context_.max_radius} * context_.max_radius,
                        .least = least_pixels * point.footprint,
                        .most = most_of_scene * context_.max_radius,
                        .hessian = {}};
        if (rule_ == RadiusRule::hessian && std::isfinite(sample.nearest_distance)) {
            input.hessian = find_hessian(strata, point.normal, scratch_, sample.nearest_distance,
                                         beyond_everything * context_.max_radius);
        }
        std::optional<RuledRecord> record = make_ruled_record(point.position, point.normal, sample, input);
        if (!record) return false;
        if (rule_ == RadiusRule::nearest_clamped) clamp_neighbours(*record);
        records_.push_back(*record);
        return true;
    }

    std::size_t size() const { return records_.size(); }

  private:
    /// Krivanek et al. 2006: what is near one record is near the other. Reaches are alpha times radii.
    void clamp_neighbours(RuledRecord& record) {
        for (const bool others : {false, true}) {
            for (RuledRecord& other : records_) {
                if (!(glm::dot(record.value.normal, other.value.normal) > 0.0f)) continue;
                const float apart = accuracy_ * glm::length(record.value.position - other.value.position);
                RuledRecord &longer = others ? other : record, &shorter = others ? record : other;
                longer.reach = std::max(longer.least, std::min(longer.reach, shorter.reach + apart));
            }
        }
    }

    const IndirectContext& context_;
    RadiusRule rule_;
    float accuracy_;
    GatherScratch scratch_;
    std::vector<RuledRecord> records_;
};

}  // namespace

CachedLight compute_ruled_light(const StudyFrame& frame, const RenderSettings& settings, RadiusRule rule,
                                double accuracy) {
    const LightingContext lighting = frame.lighting();
    DirectGrid direct(scene_radius(frame.shading));
    const Image<float> no_accuracy(settings.width, settings.height);
    RenderSettings gathered = settings;
    gathered.accuracy = 1.0;  // random numbers of the surface's place, as for all records
    const IndirectContext context{.lighting = lighting,
                                  .view = frame.posed.view,
                                  .settings = gathered,
                                  .accuracy = no_accuracy,
                                  .frame = static_cast<std::uint32_t>(frame.frame),
                                  .max_radius = scene_radius(frame.shading),
                                  .progress = {},
                                  .direct = &direct};
    CachedLight out;
    out.light = Image<float>(settings.width, settings.height);
    out.records = out.light;
    RayCounts counts;
    const Image<FillPoint> points = find_points(context, frame.centers, 1, counts);
    RuledCache cache(context, rule, accuracy);
    RayTask task(frame.rays);
    // Clamping may uncover a pixel: the last pass is repeated until every one is covered.
    for (int stride = first_stride; stride > 0;) {
        const std::size_t before = cache.size();
        for (int y = 0; y < points.height; y += stride) {
            for (int x = 0; x < points.width; x += stride) {
                const FillPoint& point = points(x, y);
                if (point.footprint < 0.0f || cache.covers(point)) continue;
                if (cache.add(surface_at(frame, x, y), point, task)) out.records(x, y) += 1.0f;
            }
        }
        stride = stride > 1 ? stride / 2 : (cache.size() > before ? 1 : 0);
    }
    out.record_count = cache.size();
    out.gather_rays = task.counts.gather;
    out.shadow_rays = task.counts.shadow;
    for (int y = 0; y < points.height; ++y) {
        for (int x = 0; x < points.width; ++x) {
            if (points(x, y).footprint < 0.0f) continue;
            const Rgb irradiance = cache.interpolate(points(x, y)).value_or(Rgb(0.0f));
            const Rgb reflected = reflect_unit_irradiance(surface_at(frame, x, y));
            out.light(x, y) = static_cast<float>(frame.display_luminance(reflected * irradiance));
        }
    }
    return out;
}

}  // namespace aleph
