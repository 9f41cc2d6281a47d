#include "render/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aleph {

namespace {

constexpr float estimate_alpha = 0.1f;  // narrowest lobe of the quick estimate
constexpr int batch = 16;               // shadow rays from one point towards one light, in one packet

float fraction(float x) {
    return x - std::floor(x);
}

/// Shadow rays collected until a packet is full; what is not blocked is added up in order.
class ShadowBatch {
  public:
    ShadowBatch(Tracer& tracer, RayCounts& counts, Rgb& sum) : tracer_(tracer), counts_(counts), sum_(sum) {}

    void add(const glm::vec3& origin, const glm::vec3& direction, float distance, const Rgb& contribution) {
        if (contribution == Rgb(0.0f)) return;
        rays_[size_] = {origin, direction, 0.0f, distance};
        contributions_[size_++] = contribution;
        if (size_ == batch) flush();
    }

    void flush() {
        std::array<std::uint8_t, batch> blocked;
        tracer_.occluded(std::span(rays_.data(), size_), std::span(blocked.data(), size_));
        counts_.shadow += size_;
        for (std::size_t i = 0; i < size_; ++i) {
            if (!blocked[i]) sum_ += contributions_[i];
        }
        size_ = 0;
    }

  private:
    Tracer& tracer_;
    RayCounts& counts_;
    Rgb& sum_;
    std::size_t size_ = 0;
    std::array<Ray, batch> rays_;
    std::array<Rgb, batch> contributions_;
};

/// f cos for a light sample; the glossy part weighted against visible-normal sampling.
Rgb scatter(const SurfacePoint& point, const SurfaceMaterial& material, const Basis& basis, const glm::vec3& view,
            const glm::vec3& local_view, const LightSample& sample) {
    const float cosine = glm::dot(point.normal, sample.direction);
    if (!(cosine > 0.0f) || !(glm::dot(point.geometric, sample.direction) > 0.0f)) return Rgb(0.0f);
    Rgb f(0.0f);
    const float cos_view = std::max(glm::dot(point.normal, view), 0.0f);
    if (material.has_diffuse()) f += evaluate_diffuse(material, cos_view, cosine);
    if (material.has_glossy()) {
        const glm::vec3 local_light = basis.to_local(sample.direction);
        const float weight =
            sample.pdf > 0.0f ? power_heuristic(sample.pdf, pdf_glossy(material, local_view, local_light)) : 1.0f;
        f += evaluate_glossy(material, local_view, local_light) * weight;
    }
    return f * cosine;
}

/// One direction by the glossy lobe: what it meets of the lights, weighted against light sampling.
Rgb sample_glossy_light(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                        const SurfaceMaterial& material, const Basis& basis, const glm::vec3& local_view,
                        const glm::vec2& u, RayCounts& counts) {
    const glm::vec3 local = sample_glossy(material, local_view, u);
    const glm::vec3 direction = basis.to_world(local);
    if (!(local.z > 0.0f) || !(glm::dot(direction, point.geometric) > 0.0f)) return Rgb(0.0f);
    const float pdf = pdf_glossy(material, local_view, local);
    if (!(pdf > 0.0f)) return Rgb(0.0f);
    ++counts.glossy;
    const Hit hit = tracer.intersect({point.ray_origin(), direction});
    Rgb incoming(0.0f);
    float light_pdf = 0.0f;
    if (hit.instance == no_index) {
        incoming = context.lights.environment;
        light_pdf = pdf_cosine_hemisphere(local.z);
    } else {
        const int emitter = context.lights.emitter_of_instance[hit.instance];
        if (emitter == no_index) return Rgb(0.0f);
        const SurfacePoint lamp = make_surface_point(context.shading, hit, direction);
        incoming = evaluate_material(context.shading, lamp, {}).emission;
        light_pdf = pdf_emitter(context.lights.emitters[emitter], point.ray_origin(),
                                std::abs(glm::dot(lamp.geometric, direction)), hit.distance);
    }
    return evaluate_glossy(material, local_view, local) * incoming * (local.z / pdf * power_heuristic(pdf, light_pdf));
}

bool has_area(const LightSet& lights, int light) {
    const int emitters = static_cast<int>(lights.emitters.size());
    return light < emitters || light >= emitters + static_cast<int>(lights.punctual.size());
}

}  // namespace

glm::vec2 lattice_point(int i, int n, const glm::vec2& shift) {
    constexpr float golden = 0.61803398875f;
    return {std::min(fraction((static_cast<float>(i) + 0.5f) / static_cast<float>(n) + shift.x), 0x1.fffffep-1f),
            std::min(fraction(static_cast<float>(i) * golden + shift.y), 0x1.fffffep-1f)};
}

Rgb compute_direct_light(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                         const SurfaceMaterial& material, const glm::vec3& view, const LightPoints& points,
                         RandomStream& random, RayCounts& counts) {
    const Basis basis = make_basis(point.normal);
    const glm::vec3 local_view = basis.to_local(view);
    const bool glossy = material.has_glossy() && local_view.z > 0.0f;
    Rgb sum(0.0f);
    ShadowBatch shadows(tracer, counts, sum);
    for (int light = 0; light < context.lights.count(); ++light) {
        const LightPoints on_light = has_area(context.lights, light) ? points : LightPoints{};
        const glm::vec2 shift = random.next_2d();
        for (int i = 0; i < on_light.count; ++i) {
            const LightSample sample = sample_light(context.shading, context.lights, light, point.ray_origin(),
                                                    point.normal, on_light.at(i, shift));
            const Rgb f = scatter(point, material, basis, view, local_view, sample);
            shadows.add(point.ray_origin(), sample.direction, sample.distance,
                        f * sample.incoming / static_cast<float>(on_light.count));
        }
    }
    shadows.flush();
    const glm::vec2 shift = random.next_2d();
    if (glossy && (!context.lights.emitters.empty() || context.lights.has_environment)) {
        Rgb glossy_sum(0.0f);
        for (int i = 0; i < points.count; ++i) {
            glossy_sum +=
                sample_glossy_light(context, tracer, point, material, basis, local_view, points.at(i, shift), counts);
        }
        sum += glossy_sum / static_cast<float>(points.count);
    }
    return sum;
}

Rgb estimate_direct_light(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                          const SurfaceMaterial& material, const glm::vec3& view, int samples, RayCounts& counts) {
    Rgb sum(0.0f);
    const Basis basis = make_basis(point.normal);
    const glm::vec3 local_view = basis.to_local(view);
    const float cos_view = std::max(local_view.z, 0.0f);
    // A narrow lobe would pick single points of the pattern: widened, the highlight is there without sparkling.
    SurfaceMaterial widened = material;
    widened.alpha = std::max(material.alpha, estimate_alpha);
    ShadowBatch shadows(tracer, counts, sum);
    for (int light = 0; light < context.lights.count(); ++light) {
        const int light_samples = has_area(context.lights, light) ? samples : 1;
        for (int i = 0; i < light_samples; ++i) {
            const LightSample sample =
                sample_light(context.shading, context.lights, light, point.ray_origin(), point.normal,
                             lattice_point(i, light_samples, {0.0f, 0.25f}), 1.0f / static_cast<float>(light_samples));
            const float cosine = glm::dot(point.normal, sample.direction);
            if (!(cosine > 0.0f) || !(glm::dot(point.geometric, sample.direction) > 0.0f)) continue;
            Rgb f(0.0f);
            if (material.has_diffuse()) f += evaluate_diffuse(material, cos_view, cosine);
            if (material.has_glossy()) f += evaluate_glossy(widened, local_view, basis.to_local(sample.direction));
            shadows.add(point.ray_origin(), sample.direction, sample.distance,
                        f * sample.incoming * (cosine / static_cast<float>(light_samples)));
        }
    }
    shadows.flush();
    return sum;
}

}  // namespace aleph
