// Texture pyramids: each texel is the mean of the finer level over exactly the texel's area.

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

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

TextureSet make_texture_set(const Scene& scene) {
    TextureSet set;
    std::vector<std::array<int, 3>> known(scene.images.size(), {no_index, no_index, no_index});
    const auto use = [&](const TextureRef& reference, TextureSpace space, bool by_alpha) {
        if (reference.image == no_index) return TextureUse{};
        const SceneImage& image = scene.images[reference.image];
        if (image.bytes.empty() && image.floats.empty()) return TextureUse{};
        // A float image reads the same in both spaces.
        const std::size_t slot = by_alpha ? 2 : space == TextureSpace::srgb && !image.bytes.empty() ? 1 : 0;
        int& index = known[reference.image][slot];
        if (index == no_index) {
            index = static_cast<int>(set.textures.size());
            set.textures.push_back({.image = &image, .space = space, .by_alpha = by_alpha});
        }
        return make_texture_use(reference, index);
    };
    const std::vector<std::uint8_t> shown = list_shown_materials(scene);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        MaterialTextures& textures = set.materials.emplace_back();
        if (shown[m] == 0) continue;
        const Material& material = scene.materials[m];
        for (const auto& [key, slot] : material_textures) {
            textures[slot] = use(material.textures[slot], is_color(slot) ? TextureSpace::srgb : TextureSpace::linear,
                                 slot == TextureSlot::base_color && shows_by_alpha(material.opacity));
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
    return set;
}

}  // namespace aleph
