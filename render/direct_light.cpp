#include "render/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aleph {

namespace {

constexpr float min_estimate_alpha = 0.1f;  // GGX width of the quick estimate's lobes
constexpr int batch_size = 16;              // shadow rays from one point, in one packet

/// Shadow rays collected until a packet is full. The contributions of those that are not blocked are added in order.
class ShadowBatch {
  public:
    ShadowBatch(RayTask& task, Rgb& sum) : task_(task), sum_(sum) {}

    void add(const glm::vec3& origin, const LightSample& sample, const Rgb& contribution) {
        if (contribution == Rgb(0.0f)) return;
        rays_[size_] = {origin, sample.direction, 0.0f, sample.distance};
        contributions_[size_++] = contribution;
        if (size_ == batch_size) flush();
    }

    void flush() {
        std::array<std::uint8_t, batch_size> blocked;
        task_.tracer.occluded(std::span(rays_.data(), size_), std::span(blocked.data(), size_));
        task_.counts.shadow += size_;
        for (std::size_t i = 0; i < size_; ++i) {
            if (!blocked[i]) sum_ += contributions_[i];
        }
        size_ = 0;
    }

  private:
    RayTask& task_;
    Rgb& sum_;
    std::size_t size_ = 0;
    std::array<Ray, batch_size> rays_;
    std::array<Rgb, batch_size> contributions_;
};

/// A surface with its shading frame.
struct LitSurface {
    explicit LitSurface(const ViewedSurface& s)
        : point(s.point),
          material(s.material),
          basis(make_basis(s.point.normal)),
          local_view(basis.to_local(s.view)),
          cos_view(std::max(local_view.z, 0.0f)) {}

    /// Above both the shading normal's and the geometric normal's horizon.
    bool faces(const glm::vec3& direction) const {
        return glm::dot(point.normal, direction) > 0.0f && glm::dot(point.geometric, direction) > 0.0f;
    }

    const SurfacePoint& point;
    const SurfaceMaterial& material;
    Basis basis;
    glm::vec3 local_view;  ///< towards the viewer, z along the shading normal
    float cos_view;
};

/// compute_direct_light's samples: at random points, with the glossy part weighted against visible-normal sampling.
struct RandomPattern {
    RandomStream& random;
    LightPoints points;

    glm::vec2 next_shift() { return random.next_2d(); }
    float light_share(int) const { return 0.0f; }

    Rgb reflect(const LitSurface& lit, const LightSample& sample, float cosine, int count) const {
        const SurfaceMaterial& material = lit.material;
        Rgb f(0.0f);
        if (material.has_diffuse()) f += evaluate_diffuse(material, lit.cos_view, cosine);
        if (material.has_glossy()) {
            const glm::vec3 local_light = lit.basis.to_local(sample.direction);
            const float lobe_pdf = sample.pdf > 0.0f ? pdf_glossy(material, lit.local_view, local_light) : 0.0f;
            const float weight = sample.pdf > 0.0f ? power_heuristic(sample.pdf, lobe_pdf) : 1.0f;
            f += evaluate_glossy(material, lit.local_view, local_light) * weight;
        }
        return f * cosine * sample.incoming / static_cast<float>(count);
    }
};

/// estimate_direct_light's samples: the same points for every pixel. A narrow lobe would show single points of the
/// pattern as sparkles, so lobes are widened.
struct FixedPattern {
    FixedPattern(const SurfaceMaterial& material, int samples) : widened(material), points{samples} {
        widened.alpha = std::max(material.alpha, min_estimate_alpha);
    }

    SurfaceMaterial widened;
    LightPoints points;

    glm::vec2 next_shift() const { return {0.0f, 0.25f}; }
    float light_share(int count) const { return 1.0f / static_cast<float>(count); }

    Rgb reflect(const LitSurface& lit, const LightSample& sample, float cosine, int count) const {
        Rgb f(0.0f);
        if (widened.has_diffuse()) f += evaluate_diffuse(widened, lit.cos_view, cosine);
        if (widened.has_glossy()) {
            f += evaluate_glossy(widened, lit.local_view, lit.basis.to_local(sample.direction));
        }
        return f * sample.incoming * (cosine / static_cast<float>(count));
    }
};

bool has_area(const LightSet& lights, int light) {
    const int emitters = static_cast<int>(lights.emitters.size());
    return light < emitters || light >= emitters + static_cast<int>(lights.punctual.size());
}

/// The reflected light of samples of every light, as a pattern places and weighs them.
template <class Pattern>
Rgb sample_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, Pattern& pattern) {
    const SurfacePoint& point = lit.point;
    Rgb sum(0.0f);
    ShadowBatch shadows(task, sum);
    for (int light = 0; light < context.lights.count(); ++light) {
        const LightPoints points = has_area(context.lights, light) ? pattern.points : LightPoints{};
        const glm::vec2 shift = pattern.next_shift();
        for (int i = 0; i < points.count; ++i) {
            const LightSample sample =
                sample_light(context.shading, context.lights, light, {point.ray_origin(), point.normal},
                             points.at(i, shift), pattern.light_share(points.count));
            if (!lit.faces(sample.direction)) continue;
            const float cosine = glm::dot(point.normal, sample.direction);
            shadows.add(point.ray_origin(), sample, pattern.reflect(lit, sample, cosine, points.count));
        }
    }
    shadows.flush();
    return sum;
}

/// One direction sampled from the glossy lobe: the light that it meets, weighted against light sampling.
Rgb sample_lobe(const LightingContext& context, RayTask& task, const LitSurface& lit, const glm::vec2& u) {
    const glm::vec3 local = sample_glossy(lit.material, lit.local_view, u);
    const glm::vec3 direction = lit.basis.to_world(local);
    if (!(local.z > 0.0f) || !(glm::dot(direction, lit.point.geometric) > 0.0f)) return Rgb(0.0f);
    const float pdf = pdf_glossy(lit.material, lit.local_view, local);
    if (!(pdf > 0.0f)) return Rgb(0.0f);
    ++task.counts.glossy;
    const Hit hit = task.tracer.intersect({lit.point.ray_origin(), direction});
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
        light_pdf = pdf_emitter(context.lights.emitters[emitter], lit.point.ray_origin(),
                                std::abs(glm::dot(lamp.geometric, direction)), hit.distance);
    }
    return evaluate_glossy(lit.material, lit.local_view, local) * incoming *
           (local.z / pdf * power_heuristic(pdf, light_pdf));
}

}  // namespace

Rgb compute_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                         const LightPoints& points, RandomStream& random) {
    const LitSurface lit(surface);
    RandomPattern pattern{random, points};
    Rgb sum = sample_lights(context, task, lit, pattern);
    const glm::vec2 shift = random.next_2d();
    const bool lights_can_be_met = !context.lights.emitters.empty() || context.lights.has_environment;
    if (surface.material.has_glossy() && lit.local_view.z > 0.0f && lights_can_be_met) {
        Rgb glossy(0.0f);
        for (int i = 0; i < points.count; ++i) glossy += sample_lobe(context, task, lit, points.at(i, shift));
        sum += glossy / static_cast<float>(points.count);
    }
    return sum;
}

Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples) {
    FixedPattern pattern(surface.material, samples);
    return sample_lights(context, task, LitSurface(surface), pattern);
}

}  // namespace aleph
