// Texture pyramids: each texel is the mean of the finer level over exactly the texel's area.

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>
#include <map>

#include "engine/base/parallel.h"
#include "engine/pose/pose.h"
#include "render/surface/texture.h"
#include "render/surface/texture_texels.h"

namespace aleph {

namespace {

/// The inputs of one output, with their weights, when a row of values is reduced by area.
struct Span {
    int first = 0, count = 0;
    double weights[4] = {};
};

/// For output i when `from` values become `to`. from / to is 1 or in [2, 3], so at most four inputs overlap an output.
Span find_span(int i, int from, int to) {
    const double scale = static_cast<double>(from) / to;
    const double begin = i * scale, end = begin + scale;
    Span span;
    span.first = static_cast<int>(std::floor(begin));
    double sum = 0.0;
    for (int k = 0; k < 4 && span.first + k < from; ++k) {
        const double overlap = std::min(end, span.first + k + 1.0) - std::max(begin, span.first + k + 0.0);
        if (!(overlap > 1e-9)) break;
        span.weights[span.count++] = overlap;
        sum += overlap;
    }
    for (double& weight : span.weights) weight /= sum;
    return span;
}

std::vector<Span> find_spans(int from, int to) {
    std::vector<Span> spans;
    for (int i = 0; i < to; ++i) spans.push_back(find_span(i, from, to));
    return spans;
}

/// The next coarser level. In double, so that a constant image stays exactly constant. A texel that is not finite
/// counts as 0, because it would spoil all coarser levels.
template <class Read>
Image<glm::vec4> reduce(int width, int height, const Read& read) {
    Image<glm::vec4> out(std::max(1, width / 2), std::max(1, height / 2));
    const std::vector<Span> columns = find_spans(width, out.width), rows = find_spans(height, out.height);
    for (int y = 0; y < out.height; ++y) {
        const Span& row = rows[y];
        for (int x = 0; x < out.width; ++x) {
            const Span& column = columns[x];
            glm::dvec4 sum(0.0);
            for (int j = 0; j < row.count; ++j) {
                for (int i = 0; i < column.count; ++i) {
                    const glm::dvec4 texel(read(column.first + i, row.first + j));
                    for (int c = 0; c < 4; ++c) {
                        if (std::isfinite(texel[c])) sum[c] += row.weights[j] * column.weights[i] * texel[c];
                    }
                }
            }
            out(x, y) = glm::vec4(sum);
        }
    }
    return out;
}

bool has_holes(const Texture& texture) {
    for (int y = 0; y < texture.height; ++y) {
        for (int x = 0; x < texture.width; ++x) {
            if (read_texel(*texture.image, x, y, texture.space).w != 1.0f) return true;
        }
    }
    return false;
}

/// Returns whether a surface does not show where the alpha of its texture is 0.
bool shows_by_alpha(const Opacity& opacity) {
    return opacity.mode == Opacity::Mode::blend || (opacity.mode == Opacity::Mode::mask && opacity.cutoff > 0.0);
}

/// An image in a space, and the one whose alpha makes holes where it is seen: itself, a base colour, or none.
struct TextureKey {
    int image = no_index;
    TextureSpace space = TextureSpace::linear;
    int alpha = no_index;
    auto operator<=>(const TextureKey&) const = default;
};

/// Returns the image whose alpha makes holes in a material's texture. Where the alpha of a texture is itself a value,
/// no other replaces it.
int find_alpha(const Material& material, TextureSlot slot) {
    const TextureRef& base = material.textures[TextureSlot::base_color];
    if (base.image == no_index || !shows_by_alpha(material.opacity)) return no_index;
    if (slot == TextureSlot::specular || slot == TextureSlot::sheen_roughness || is_normal_map(slot)) return no_index;
    TextureRef same = material.textures[slot];
    same.image = base.image;
    same.nearest = base.nearest;
    return same == base ? base.image : no_index;
}

/// An image with the mean alpha of another over each of its texels.
SceneImage mask_image(const SceneImage& image, const TextureSet& set, int alpha) {
    SceneImage masked = image;
    const int width = std::max(image.bytes.width, image.floats.width);
    const int height = std::max(image.bytes.height, image.floats.height);
    const TextureUse use{.texture = alpha, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    const glm::vec2 texel(1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) * texel;
            const float left = sample_texture(set, use, uv, {{texel.x, 0.0f}, {0.0f, texel.y}}).w;
            if (image.bytes.empty())
                masked.floats(x, y).w = left;
            else
                masked.bytes(x, y).w = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(left, 0.0f, 1.0f)));
        }
    }
    return masked;
}

/// Finds the range of all texels, without values that are not numbers.
void find_range(Texture& texture) {
    glm::vec3 &smallest = texture.smallest, &largest = texture.largest;
    smallest = glm::vec3(std::numeric_limits<float>::max());
    for (int y = 0; y < texture.height; ++y) {
        for (int x = 0; x < texture.width; ++x) {
            const glm::vec4 texel = read_texel(*texture.image, x, y, texture.space);
            for (int c = 0; c < 3; ++c) {
                smallest[c] = std::min(smallest[c], texel[c]);
                largest[c] = std::max(largest[c], texel[c]);
            }
        }
    }
}

/// Per material: it is on a mesh that is shown at some time.
std::vector<std::uint8_t> list_shown_materials(const Scene& scene) {
    const std::vector<Instance> instances = list_instances(scene);
    const std::vector<std::uint8_t> ever_shown = list_ever_shown(scene);
    std::vector<std::uint8_t> shown(scene.materials.size(), 0);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const int material = scene.meshes[instances[i].mesh].material;
        if (ever_shown[i] != 0 && material != no_index) shown[material] = 1;
    }
    return shown;
}

}  // namespace

Texture make_texture(const SceneImage& image, TextureSpace space, bool by_alpha) {
    Texture texture;
    texture.image = &image;
    texture.space = space;
    texture.width = image.bytes.empty() ? image.floats.width : image.bytes.width;
    texture.height = image.bytes.empty() ? image.floats.height : image.bytes.height;
    texture.by_alpha = by_alpha && has_holes(texture);
    find_range(texture);
    if (texture.width <= 1 && texture.height <= 1) return texture;
    texture.coarse.push_back(reduce(texture.width, texture.height, [&](int x, int y) {
        const glm::vec4 texel = read_texel(image, x, y, space);
        return texture.by_alpha ? weigh_by_alpha(texel) : texel;
    }));
    while (texture.coarse.back().size() > 1) {
        const Image<glm::vec4>& finer = texture.coarse.back();
        texture.coarse.push_back(reduce(finer.width, finer.height, [&](int x, int y) { return finer(x, y); }));
    }
    return texture;
}

TextureUse make_texture_use(const TextureRef& reference, int texture) {
    TextureUse use;
    use.texture = texture;
    use.uv_set = reference.uv_set == 1 ? 1 : 0;
    use.wrap_u = reference.wrap_u;
    use.wrap_v = reference.wrap_v;
    use.nearest = reference.nearest;
    use.transformed =
        reference.uv_offset != glm::dvec2(0.0) || reference.uv_scale != glm::dvec2(1.0) || reference.uv_rotation != 0.0;
    if (use.transformed) {
        // Counter-clockwise with v pointing down. The code in the extension's text turns the other way (glTF issue
        // 1563).
        const double c = std::cos(reference.uv_rotation), s = std::sin(reference.uv_rotation);
        use.matrix =
            glm::mat2(glm::dmat2(c, -s, s, c) * glm::dmat2(reference.uv_scale.x, 0.0, 0.0, reference.uv_scale.y));
        use.offset = glm::vec2(reference.uv_offset);
    }
    return use;
}

namespace {

/// Gives textures the holes of base colours, which have been made.
void mask_textures(const Scene& scene, const std::map<TextureKey, int>& known, TextureSet& set) {
    for (const auto& [key, index] : known) {
        if (key.alpha == no_index || key.alpha == key.image) continue;
        const SceneImage& alpha = scene.images[key.alpha];
        const auto holes =
            known.find({key.alpha, alpha.bytes.empty() ? TextureSpace::linear : TextureSpace::srgb, key.alpha});
        if (holes == known.end() || !set.textures[holes->second].by_alpha) continue;
        auto masked = std::make_shared<const SceneImage>(mask_image(scene.images[key.image], set, holes->second));
        set.textures[index] = make_texture(*masked, key.space, true);
        set.textures[index].masked = std::move(masked);
    }
}

}  // namespace

TextureSet make_texture_set(const Scene& scene) {
    TextureSet set;
    std::map<TextureKey, int> known;
    const auto use = [&](const TextureRef& reference, TextureSpace space, int alpha) {
        if (reference.image == no_index) return TextureUse{};
        const SceneImage& image = scene.images[reference.image];
        if (image.bytes.empty() && image.floats.empty()) return TextureUse{};
        if (image.bytes.empty()) space = TextureSpace::linear;  // a float image reads the same in both
        const auto next = static_cast<int>(set.textures.size());
        const auto [at, is_new] = known.try_emplace({reference.image, space, alpha}, next);
        if (is_new) set.textures.push_back({.image = &image, .space = space, .by_alpha = alpha == reference.image});
        return make_texture_use(reference, at->second);
    };
    const std::vector<std::uint8_t> shown = list_shown_materials(scene);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        MaterialTextures& textures = set.materials.emplace_back();
        if (shown[m] == 0) continue;
        const Material& material = scene.materials[m];
        for (const auto& [key, slot] : material_textures) {
            textures[slot] = use(material.textures[slot], is_color(slot) ? TextureSpace::srgb : TextureSpace::linear,
                                 find_alpha(material, slot));
            if (textures[slot].texture == no_index) continue;
            textures.any = true;
            textures.maps_normals = textures.maps_normals || is_normal_map(slot);
        }
    }
    set.materials.emplace_back();
    if (scene.environment.radiance && scene.environment.image != no_index) {
        set.environment = make_environment_map(scene.images[scene.environment.image]);
    }
    parallel_each(set.textures.size(), 1, [&](std::size_t i) {
        const Texture& wanted = set.textures[i];
        set.textures[i] = make_texture(*wanted.image, wanted.space, wanted.by_alpha);
    });
    mask_textures(scene, known, set);
    return set;
}

}  // namespace aleph
