#include "engine/rays/alpha_cutout.h"

#include <algorithm>
#include <cmath>

namespace aleph {
namespace {

int wrap(int i, int size, Wrap how) {
    switch (how) {
        case Wrap::clamp:
            return std::clamp(i, 0, size - 1);
        case Wrap::repeat:
            return ((i % size) + size) % size;
        case Wrap::mirror:
            break;
    }
    const int period = 2 * size, place = ((i % period) + period) % period;
    return place < size ? place : period - 1 - place;
}

template <class T>
T between(const std::vector<T>& values, const glm::uvec3& t, float u, float v) {
    return values[t.x] * (1.0f - u - v) + values[t.y] * u + values[t.z] * v;
}

bool is_opaque(const SceneImage& image) {
    return std::ranges::all_of(image.bytes.pixels, [](const glm::u8vec4& p) { return p.w == 255; }) &&
           std::ranges::all_of(image.floats.pixels, [](const glm::vec4& p) { return p.w == 1.0f; });
}

/// True where alpha is 1 everywhere, at every time.
bool is_opaque(const Scene& scene, const Mesh& mesh, const Material& material) {
    const int image = material.textures[TextureSlot::base_color].image;
    return !is_animated(material.opacity.alpha) && evaluate(material.opacity.alpha, 0.0) == 1.0 &&
           std::ranges::all_of(mesh.colors, [](const glm::vec4& color) { return color.w == 1.0f; }) &&
           (image == no_index || is_opaque(scene.images[image]));
}

}  // namespace

float AlphaTexture::sample(const glm::vec2& given) const {
    if (alpha.empty()) return 1.0f;
    const double c = std::cos(reference.uv_rotation), s = std::sin(reference.uv_rotation);
    const glm::dvec2 scaled = glm::dvec2(given) * reference.uv_scale;
    const glm::vec2 uv(reference.uv_offset + glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x));
    // Mirroring has period 2: indices stay small whatever the repeat count.
    const auto texels = [](float at, int size, Wrap how) {
        const float reached = std::abs(at) < max_texture_coordinate ? at : 0.0f;
        const float near =
            how == Wrap::clamp ? std::clamp(reached, 0.0f, 1.0f) : reached - 2.0f * std::floor(0.5f * reached);
        return near * static_cast<float>(size);
    };
    const float x = texels(uv.x, alpha.width, reference.wrap_u), y = texels(uv.y, alpha.height, reference.wrap_v);
    const auto texel = [&](float column, float row) {
        return alpha(wrap(static_cast<int>(column), alpha.width, reference.wrap_u),
                     wrap(static_cast<int>(row), alpha.height, reference.wrap_v));
    };
    if (reference.nearest) return texel(std::floor(x), std::floor(y));
    const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
    const float ax = x - 0.5f - x0, ay = y - 0.5f - y0;
    return (1.0f - ay) * ((1.0f - ax) * texel(x0, y0) + ax * texel(x0 + 1.0f, y0)) +
           ay * ((1.0f - ax) * texel(x0, y0 + 1.0f) + ax * texel(x0 + 1.0f, y0 + 1.0f));
}

AlphaTexture make_alpha_texture(const Scene& scene, const TextureRef& reference) {
    AlphaTexture texture;
    texture.reference = reference;
    if (reference.image == no_index) return texture;
    const SceneImage& image = scene.images[reference.image];
    if (!image.bytes.empty()) {
        texture.alpha = Image<float>(image.bytes.width, image.bytes.height);
        std::ranges::transform(image.bytes.pixels, texture.alpha.pixels.begin(),
                               [](const glm::u8vec4& p) { return static_cast<float>(p.w) / 255.0f; });
    } else if (!image.floats.empty()) {
        texture.alpha = Image<float>(image.floats.width, image.floats.height);
        std::ranges::transform(image.floats.pixels, texture.alpha.pixels.begin(),
                               [](const glm::vec4& p) { return p.w; });
    }
    return texture;
}

float AlphaCutout::alpha_at(float material_alpha, unsigned primitive, float u, float v) const {
    const glm::uvec3& t = triangles[primitive];
    float alpha = material_alpha * texture.sample(uv.empty() ? glm::vec2(0.0f) : between(uv, t, u, v));
    if (!vertex_alpha.empty()) alpha *= between(vertex_alpha, t, u, v);
    return alpha;
}

bool has_cutout(const Scene& scene, const Mesh& mesh) {
    if (mesh.material == no_index) return false;
    const Material& material = scene.materials[mesh.material];
    if (material.opacity.mode == Opacity::Mode::opaque) return false;
    const bool one_is_whole = material.opacity.mode == Opacity::Mode::blend || material.opacity.cutoff <= 1.0;
    return !(one_is_whole && is_opaque(scene, mesh, material));
}

bool has_blended(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, [&](const Node& node) {
        return std::ranges::any_of(node.meshes, [&](int index) {
            const Mesh& mesh = scene.meshes[index];
            return mesh.material != no_index && scene.materials[mesh.material].opacity.mode == Opacity::Mode::blend &&
                   has_cutout(scene, mesh);
        });
    });
}

AlphaCutout make_alpha_cutout(const Scene& scene, const Mesh& mesh) {
    const Material& material = scene.materials[mesh.material];
    AlphaCutout cutout;
    cutout.material = mesh.material;
    cutout.blended = material.opacity.mode == Opacity::Mode::blend;
    const auto& transmission = material.glass.transmission;
    cutout.plain = cutout.blended && !is_animated(transmission) && !(evaluate(transmission, 0.0) > 0.0);
    if (!cutout.blended) cutout.cutoff = static_cast<float>(material.opacity.cutoff);
    cutout.texture = make_alpha_texture(scene, material.textures[TextureSlot::base_color]);
    cutout.triangles = mesh.triangles;
    cutout.uv = mesh.uv[material.textures[TextureSlot::base_color].uv_set == 1 ? 1 : 0];
    for (const glm::vec4& color : mesh.colors) cutout.vertex_alpha.push_back(color.w);
    return cutout;
}

}  // namespace aleph
