#include "render/shade/texture_control.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr std::uint32_t control_key_mask = 0x74657874u;  // apart from the samples' own places
constexpr int texels = 4;                                // beside that of a sample
constexpr float least_gain = 1.5f;                       // of the squared error, for which a correction pays
constexpr float least_texel = 0.02f;                     // darker ones would make a scale of any size
constexpr float most_scale = 1e20f;

const TextureUse* find_base_color(const ShadingScene& shading, const Hit& hit) {
    const MaterialTextures& textures = shading.textures->materials[shading.instances[hit.instance].material];
    const TextureUse& use = textures[TextureSlot::base_color];
    return textures.any && use.texture != no_index ? &use : nullptr;
}

UvFootprint find_footprint(const CameraView& view, const PixelSurface& surface, int uv_set) {
    return make_uv_footprint(
        surface.point, make_pixel_footprint(view, surface.point, -surface.view, surface.hit.distance, 1.0f), uv_set);
}

/// From the texel at a pixel's centre to what the Lambert layer reflects of the estimate; 0 where that is not finite.
Rgb find_scale(const ShadingScene& shading, const CameraView& view, const PixelSurface& surface,
               const TextureUse& texture, const Rgb& estimate) {
    const SurfaceMaterial& material = surface.material;
    const Rgb texel(sample_texture(*shading.textures, texture, surface.point.uv[texture.uv_set],
                                   find_footprint(view, surface, texture.uv_set)));
    const Rgb reflected = glm::max(estimate - material.emission, Rgb(0.0f)),
              whole = material.diffuse + material.gloss.f0;
    Rgb scale(0.0f);
    for (int c = 0; c < 3; ++c) {
        if (whole[c] > 0.0f) scale[c] = material.diffuse[c] / whole[c] * reflected[c] / std::max(texel[c], least_texel);
    }
    return glm::all(glm::lessThan(scale, Rgb(most_scale))) ? scale : Rgb(0.0f);  // also where one is NaN
}

}  // namespace

PixelTexture::PixelTexture(const ShadingScene& shading, const CameraView& view, const PixelSurface& surface,
                           const TextureUse& texture, const Rgb& scale)
    : shading_(shading),
      view_(view),
      texture_(texture),
      pixel_(surface.x, surface.y),
      position_(surface.point.position),
      uv_(surface.point.uv[texture.uv_set]),
      footprint_(find_footprint(view, surface, texture.uv_set)),
      scale_(scale) {
    const glm::dvec3 e1(surface.point.edges[0]), e2(surface.point.edges[1]), normal = glm::cross(e1, e2);
    const double squared = glm::dot(normal, normal);
    if (!(squared > 0.0)) return;
    const auto& uv_edges = surface.point.uv_edges[texture.uv_set];
    for (int c = 0; c < 2; ++c) {
        uv_slopes_[c] = (glm::cross(e2, normal) * static_cast<double>(uv_edges[0][c]) +
                         glm::cross(normal, e1) * static_cast<double>(uv_edges[1][c])) /
                        squared;
    }
    normal_ = normal;
}

Rgb PixelTexture::expect(const glm::dvec2& film, float spacing) const {
    const CameraRay ray = make_camera_ray(view_, film.x, film.y);
    const glm::dvec3 from = ray.origin - shading_.anchor - position_;
    const double along = glm::dot(ray.direction, normal_);
    const glm::dvec3 to = from - ray.direction * (glm::dot(from, normal_) / along);
    const glm::vec2 uv(uv_ + glm::dvec2(glm::dot(to, uv_slopes_[0]), glm::dot(to, uv_slopes_[1])));
    const UvFootprint footprint{footprint_.dx * spacing, footprint_.dy * spacing, footprint_.round};
    return scale_ * Rgb(sample_texture(*shading_.textures, texture_, uv, footprint));
}

Rgb PixelTexture::correct(const SamplePlace& place) const {
    if (normal_ == glm::dvec3(0.0)) return Rgb(0.0f);
    SamplePlace other = place;
    other.noise_key ^= control_key_mask;
    Rgb sum(0.0f);
    for (int i = 0; i < texels; ++i) {
        other.index = place.index * texels + i;
        sum += expect(place_sample(other, pixel_.x, pixel_.y), place.spacing);
    }
    return sum / static_cast<float>(texels) - expect(place_sample(place, pixel_.x, pixel_.y), place.spacing);
}

TextureControl::TextureControl(const ShadingScene& shading, const CameraView& view, const SampleHits& centers,
                               const Image<Rgb>& estimate, double exposure)
    : shading_(shading),
      view_(view),
      centers_(centers),
      scales_(view.width, view.height),
      corrects_(view.width, view.height) {
    parallel_pixels(centers.hits, 16, [&](int x, int y) {
        const Hit& hit = centers.hits(x, y);
        const TextureUse* const texture = hit.instance == no_index ? nullptr : find_base_color(shading, hit);
        if (texture == nullptr) return;
        const PixelSurface surface = make_pixel_surface(shading, view, centers, x, y);
        const Rgb radiance = estimate(x, y) / static_cast<float>(exposure);
        scales_(x, y) = find_scale(shading, view, surface, *texture, radiance);
        bool is_alone = true;
        visit_around(centers.hits, x, y, 1,
                     [&](int nx, int ny) { is_alone = is_alone && centers.hits(nx, ny).instance == hit.instance; });
        corrects_(x, y) = is_alone ? 1 : 0;
    });
}

PixelTexture TextureControl::find_texture(int x, int y) const {
    // A highlight on a dark texel makes a scale of tens, and noise in one pixel that none around it tells of.
    Rgb scale = scales_(x, y);
    visit_around(scales_, x, y, 1, [&](int nx, int ny) { scale = glm::min(scale, scales_(nx, ny)); });
    const PixelSurface surface = make_pixel_surface(shading_, view_, centers_, x, y);
    return {shading_, view_, surface, *find_base_color(shading_, centers_.hits(x, y)), scale};
}

void TextureControl::choose(std::span<const PixelRange> stage, const Image<PixelSamples>& pixels) {
    for (const PixelRange& range : stage) {
        if (range.first == 0 || !corrects(range.x, range.y)) continue;
        float corrected = 0.0f, uncorrected = 0.0f;
        visit_around(pixels, range.x, range.y, 1, [&](int x, int y) {
            corrected += pixels(x, y).error().total;
            uncorrected += pixels(x, y).error().uncorrected;
        });
        if (!(uncorrected > least_gain * corrected)) corrects_(range.x, range.y) = 0;
    }
}

}  // namespace aleph
