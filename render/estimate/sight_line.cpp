#include "render/estimate/sight_line.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "engine/rays/first_hits.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

namespace {

constexpr int most_surfaces = 16;
constexpr float least_left = 0.01f;
constexpr float least_blurred = 0.3f;  // of what rough surfaces reflect: metals, and others at grazing angles

constexpr int most_layers = 4;
constexpr float good_part = 0.1f;

/// Returns whether a material may be glass or a mirror.
bool shows_others(const ShadingMaterial& m) {
    const float roughness = m.values.gloss.roughness;
    const bool mirror =
        roughness * roughness < min_ggx_alpha ||
        (m.material != nullptr && m.material->textures[TextureSlot::metallic_roughness].image != no_index);
    return m.values.glass.transmission > 0.0f || (mirror && !m.plain_lambert);
}

}  // namespace

SightStart start_at_center(const CameraView& view, const SampleHits& centers, const glm::ivec2& pixel) {
    return {.view = view,
            .pixel = pixel,
            .ray = make_camera_ray(view, pixel.x + 0.5, pixel.y + 0.5),
            .hit = centers.hits(pixel.x, pixel.y),
            .beside = view.orthographic};
}

SightLine::SightLine(const LightingContext& context, Tracer& tracer, const SightStart& start, int number)
    : lighting_(context),
      tracer_(tracer),
      start_(start),
      number_(number),
      way_{to_scene(context.rays, start.ray), context.around} {}

bool SightLine::advance(RayCounts& counts) {
    if (surfaces_ == most_surfaces || largest_channel(way_.left) <= least_left) {
        way_.left = Rgb(0.0f);
        return false;
    }
    const float before = last_.hit.distance;
    last_ = meet(counts);
    ++surfaces_;
    if (last_.hit.instance == no_index) return false;
    Hit hit = last_.hit;
    hit.distance += way_.travelled;
    surface_ = make_pixel_surface(lighting_.shading, start_.view, SamplePlace{}, hit, way_.ray.direction, start_.pixel);
    if (surfaces_ == 1 && start_.beside && !way_.media.is_empty()) {
        const SurfacePoint& point = surface_.point;
        way_.media = find_media(lighting_.shading, tracer_, {point.ray_origin(), point.geometric}, counts.primary);
    }
    lighting_.around = way_.media;
    SurfaceMaterial& material = surface_.material;
    if (material.glass.volume) material.glass.ior_ratio = way_.media.ratio_at(surface_);
    way_.left *= transmit(way_.media.attenuation(surface_.point, material), last_.hit.distance - before);
    share_ = way_.left * last_.alpha;
    way_.left -= share_;
    emission_ = met_emission(lighting_, way_.turned, surface_, last_.hit);
    followed_ = {};
    if (material.is_mirror()) {
        note_reflection();
        material.gloss.f0 = Rgb(0.0f);  // what it reflects is met
        material.gloss.f90 = 0.0f;
    } else if (material.has_glossy()) {
        note_blurred_reflection();
    }
    if (material.has_glass()) pass_glass(counts);
    return true;
}

bool SightLine::reflect() {
    if (surfaces_ == most_surfaces || !reflected_) return false;
    way_ = *std::exchange(reflected_, std::nullopt);
    last_ = {};
    return true;
}

float SightLine::weight_beyond() const {
    const PathState& turned = way_.turned;
    if (turned.emission == EmissionWeight::full || !lighting_.lights.has_environment) return 1.0f;
    return power_heuristic(turned.pdf, pdf_environment(lighting_.shading, turned.from, direction()));
}

/// First hits do not tell what they passed.
Met SightLine::meet(RayCounts& counts) {
    known_ = surfaces_ == 0 && !tracer_.has_blended();
    if (known_) return {start_.hit};
    ++counts.primary;
    return tracer_.meet(way_.ray, last_.hit.instance == no_index ? nullptr : &last_);
}

/// Begins the ray that leaves the surface in a direction.
void SightLine::turn(const LitSurface& lit, const glm::vec3& direction, Way& way) const {
    way.ray = {lit.ray_origin(direction), direction};
    way.travelled += last_.hit.distance;
}

void SightLine::note_reflection() {
    const LitSurface lit(surface_);
    const glm::vec3 direction = lit.basis.to_world({-lit.view.x, -lit.view.y, lit.view.z});
    if (!(lit.view.z > 0.0f && glm::dot(lit.point.geometric, direction) > 0.0f)) return;
    if (reflected_ && reflected_->turned.emission == EmissionWeight::weighted) return;
    const Rgb left = share_ * glossy_reflectance(lit.material, lit.view.z) * lit.below_both(direction);
    if (!(largest_channel(left) > (reflected_ ? largest_channel(reflected_->left) : least_left))) return;
    reflected_ = way_;
    reflected_->left = left;
    reflected_->turned = {};
    turn(lit, direction, *reflected_);
}

void SightLine::note_blurred_reflection() {
    if (blurred_ || reflected_) return;
    ViewedSurface widened = surface_;
    widened.material.gloss.alpha = std::max(widened.material.gloss.alpha, min_estimate_alpha);
    const LitSurface lit(widened);
    const Rgb part = share_ * glossy_reflectance(lit.material, lit.cos_view) * lit.below_sheen;
    if (!(largest_channel(part) > least_blurred)) return;
    spread_ = blurred_ = true;
    followed_ = only_lobe(Lobe::gloss);
    const glm::vec2 u = lattice_point(number_, spread_lines, glm::vec2(0.0f));
    const ScatterSample sample = sample_scatter(lit, followed_, 0.0f, u, 0.0f);
    reflected_ = way_;
    reflected_->left = share_ * sample.weight;
    PathState& turned = reflected_->turned;
    turned.emission = EmissionWeight::weighted;
    turned.pdf = sample.pdf;
    turned.from = make_lambert_receiver(lighting_, lit.point);
    turn(lit, sample.direction, *reflected_);
}

void SightLine::pass_glass(RayCounts& counts) {
    GlassLayer& glass = surface_.material.glass;
    const LitSurface lit(surface_);
    if (glass.volume || !surface_.material.is_glass_smooth()) {
        turn_at_glass(lit);
    } else {
        way_.left += share_ * sheet_transmittance(lit);
        if (known_) {  // which triangles border on the hit
            ++counts.primary;
            last_ = tracer_.meet(way_.ray);
        }
    }
    glass.tint = Rgb(0.0f);  // what it passes is met
}

void SightLine::turn_at_glass(const LitSurface& lit) {
    const glm::vec2 u = lattice_point(number_, spread_lines, glm::vec2(0.0f));
    const ScatterSample sample = sample_scatter(lit, only_lobe(Lobe::glass), 0.0f, u, below_one);
    spread_ = spread_ || !lit.material.is_glass_smooth();
    if (sample.weight == Rgb(0.0f)) return;
    way_.left += share_ * (sample.passes ? sheet_transmittance(lit) : sample.weight);
    way_.turned = {};
    turn(lit, sample.direction, way_);
    last_ = {};
    if (sample.passes && lit.material.glass.volume) way_.media.pass(surface_.point, lit.material);
}

std::vector<Image<Hit>> find_layers(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                    RayCounts& counts) {
    if (!Tracer(context.rays).has_blended() && std::ranges::none_of(context.shading.materials, shows_others)) return {};
    std::vector<Image<Hit>> layers(most_layers, centers.hits);
    std::atomic<int> count = 0;
    const auto find_row = [&](int y, RayTask& task) {
        int most = 0;
        for (int x = 0; x < view.width; ++x) {
            int found = 0;
            const auto add = [&](const Rgb& share, const Hit& hit) {
                if (found < most_layers && largest_channel(share) >= good_part) layers[found++](x, y) = hit;
            };
            SightLine line(context, task.tracer, start_at_center(view, centers, {x, y}));
            while (line.advance(task.counts)) add(line.share(), line.surface().hit);
            // A mirror's picture may rest whatever the mirror does: it counts as that of the surroundings.
            add(glm::max(line.left(), line.reflected()), {});
            if (found > 1 || (found == 1 && layers[0](x, y) != centers.hits(x, y))) most = std::max(most, found);
        }
        for (int before = count; before < most && !count.compare_exchange_weak(before, most);) {
        }
    };
    cast_parallel(view.height, 4, context.rays, counts, find_row, Blend::whole);
    layers.resize(count);
    return layers;
}

}  // namespace aleph
