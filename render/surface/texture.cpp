#include "render/surface/texture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/surface/texture_texels.h"

namespace aleph {

namespace {

/// Limits the cost of a look-up. Longer footprints are blurred across as well.
constexpr int max_probes = 16;

/// A coordinate brought into [0,1]. Mirrored coordinates are folded, and their texels are then clamped at both ends.
float wrap_coordinate(float u, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(u, 0.0f, 1.0f);
    if (wrap == Wrap::repeat) return u - std::floor(u);
    const float folded = u - 2.0f * std::floor(u * 0.5f);
    return folded > 1.0f ? 2.0f - folded : folded;
}

/// For indices at most one outside [0, n).
int wrap_index(int i, int n, Wrap wrap) {
    if (i < 0) return wrap == Wrap::repeat ? n - 1 : 0;
    if (i >= n) return wrap == Wrap::repeat ? 0 : n - 1;
    return i;
}

/// Blends the four texels of one level around a place. `read` decodes them: level 0 is stored as the image's bytes.
template <class Read>
glm::vec4 blend_texels(int width, int height, const glm::vec2& place, Wrap wrap_u, Wrap wrap_v, const Read& read) {
    const float cx = place.x * static_cast<float>(width) - 0.5f, cy = place.y * static_cast<float>(height) - 0.5f;
    const float x_floor = std::floor(cx), y_floor = std::floor(cy);
    const float ax = cx - x_floor, ay = cy - y_floor;
    const int ix = static_cast<int>(x_floor), iy = static_cast<int>(y_floor);
    const int x0 = wrap_index(ix, width, wrap_u), x1 = wrap_index(ix + 1, width, wrap_u);
    const int y0 = wrap_index(iy, height, wrap_v), y1 = wrap_index(iy + 1, height, wrap_v);
    const glm::vec4 top = read(x0, y0) * (1.0f - ax) + read(x1, y0) * ax;
    const glm::vec4 bottom = read(x0, y1) * (1.0f - ax) + read(x1, y1) * ax;
    return top * (1.0f - ay) + bottom * ay;
}

/// @param place  uv within [0,1]
glm::vec4 sample_level(const Texture& texture, const TextureUse& use, int level, const glm::vec2& place) {
    const bool weigh = texture.by_alpha && level == 0;
    const auto from = [&](const auto& image, const auto& decode) {
        return blend_texels(image.width, image.height, place, use.wrap_u, use.wrap_v, [&](int x, int y) {
            const glm::vec4 texel = decode(image(x, y));
            return weigh ? weigh_by_alpha(texel) : texel;
        });
    };
    if (level > 0) return from(texture.coarse[level - 1], [](const glm::vec4& t) { return t; });
    if (texture.image->bytes.empty()) return from(texture.image->floats, [](const glm::vec4& t) { return t; });
    if (texture.space == TextureSpace::srgb) {
        return from(texture.image->bytes, [](const glm::u8vec4& t) { return decode_texel(t, TextureSpace::srgb); });
    }
    return from(texture.image->bytes, [](const glm::u8vec4& t) { return decode_texel(t, TextureSpace::linear); });
}

/// The look-ups that average a texture over a footprint.
struct Probes {
    int count = 1;
    glm::vec2 step{0.0f};    ///< uv from one probe to the next
    float level = 0.0f;      ///< 0: magnified
    bool magnified = false;  ///< the footprint is smaller than a texel
};

/// The level whose texels are this many texels of level 0 wide, within the pyramid.
float find_level(const Texture& texture, float texels) {
    const float level = std::log2(texels), coarsest = static_cast<float>(texture.coarse.size());
    return level < coarsest ? level : coarsest;  // also for NaN
}

/// Texels. A bilinear probe has the variance of a box of this width, so a footprint's axes are divided by it to get the
/// width of its probe's texels. Without it, textures would be blurred by half as much again.
constexpr float box_of_a_texel = std::numbers::sqrt2_v<float>;

/// A row of probes with the variance of a box of the footprint's width and length.
Probes place_probes(const Texture& texture, const UvFootprint& footprint) {
    const glm::vec2 size(static_cast<float>(texture.width) / box_of_a_texel,
                         static_cast<float>(texture.height) / box_of_a_texel);
    const glm::vec2 dx = footprint.dx * size, dy = footprint.dy * size;  // in units of box_of_a_texel
    const float area = std::abs(dx.x * dy.y - dx.y * dy.x);
    Probes probes;
    if (footprint.round) {
        probes.magnified = area <= 1.0f;
        probes.level = probes.magnified ? 0.0f : find_level(texture, std::sqrt(area));
        return probes;
    }
    // Axes of the ellipse J J^T, J = [dx dy]: eigenvalues mean +- root.
    const float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
    const float half_difference = 0.5f * (xx - yy);
    const float root = std::sqrt(half_difference * half_difference + xy * xy);
    const float major2 = 0.5f * (xx + yy) + root;
    if (major2 <= 1.0f) {
        probes.magnified = true;
        return probes;
    }
    const float major = std::sqrt(major2);
    if (!(major < 1e18f)) {  // NaN, or too large to square
        probes.level = static_cast<float>(texture.coarse.size());
        return probes;
    }
    const float minor = area / major;
    const float texel = std::max({minor, 1.0f, major / static_cast<float>(max_probes)});
    probes.level = find_level(texture, texel);
    probes.count = std::clamp(static_cast<int>(major / texel + 0.75f), 1, max_probes);
    if (probes.count > 1) {
        const glm::vec2 along =
            half_difference >= 0.0f ? glm::vec2(root + half_difference, xy) : glm::vec2(xy, root - half_difference);
        // n probes of texels t, s apart, and a box sqrt(2) major long: s^2 (n^2 - 1) / 12 + t^2 / 6 = 2 major^2 / 12.
        const float spread2 = (major2 - texel * texel) / static_cast<float>(probes.count * probes.count - 1);
        probes.step = along * std::sqrt(std::max(spread2, 0.0f) / (along.x * along.x + along.y * along.y)) / size;
    }
    return probes;
}

glm::vec2 wrap_place(const TextureUse& use, const glm::vec2& place) {
    return {wrap_coordinate(place.x, use.wrap_u), wrap_coordinate(place.y, use.wrap_v)};
}

glm::vec4 average_probes(const Texture& texture, const TextureUse& use, const glm::vec2& center, const Probes& probes) {
    const int level = static_cast<int>(probes.level);
    const float coarser = probes.level - static_cast<float>(level);
    glm::vec2 at = center - probes.step * (0.5f * static_cast<float>(probes.count - 1));
    glm::vec4 sum(0.0f);
    for (int i = 0; i < probes.count; ++i) {
        const glm::vec2 place = wrap_place(use, at);
        glm::vec4 value = sample_level(texture, use, level, place);
        if (coarser > 0.0f) value += (sample_level(texture, use, level + 1, place) - value) * coarser;
        sum += value;
        at += probes.step;
    }
    return sum * (1.0f / static_cast<float>(probes.count));
}

}  // namespace

glm::vec4 sample_texture(const TextureSet& set, const TextureUse& use, const glm::vec2& uv,
                         const UvFootprint& footprint) {
    if (use.texture == no_index) return glm::vec4(1.0f);
    const Texture& texture = set.textures[use.texture];
    glm::vec2 center = uv;
    Probes probes;
    if (use.transformed) {
        center = use.offset + use.matrix * uv;
        probes = place_probes(texture, {use.matrix * footprint.dx, use.matrix * footprint.dy, footprint.round});
    } else {
        probes = place_probes(texture, footprint);
    }
    for (float* u : {&center.x, &center.y}) *u = std::abs(*u) < max_texture_coordinate ? *u : 0.0f;
    if (probes.magnified && use.nearest) {
        const glm::vec2 place = wrap_place(use, center);
        const int x = static_cast<int>(place.x * static_cast<float>(texture.width));
        const int y = static_cast<int>(place.y * static_cast<float>(texture.height));
        return read_texel(*texture.image, wrap_index(x, texture.width, use.wrap_u),
                          wrap_index(y, texture.height, use.wrap_v), texture.space);
    }
    const glm::vec4 mean = average_probes(texture, use, center, probes);
    return texture.by_alpha && mean.w > 0.0f ? glm::vec4(glm::vec3(mean) / mean.w, mean.w) : mean;
}

RayFootprint make_pixel_footprint(const CameraView& view, const SurfacePoint& point, const glm::vec3& direction,
                                  float distance, float spacing) {
    const glm::vec3 right(view.axes[0]), up(view.axes[1]), back(view.axes[2]);
    // On the plane one unit in front of the camera, neighbours differ by 1 / pixels_per_unit along an axis; at this
    // depth, by that times the depth. Moving the difference along the ray brings it into the tangent plane.
    const float depth = view.orthographic ? 1.0f : -distance * glm::dot(direction, back);
    const float size = depth * spacing / static_cast<float>(view.pixels_per_unit);
    const float cosine = -glm::dot(point.geometric, direction);
    constexpr float min_cosine = 1e-4f;  // at smaller ones the texture is already blurred to the mean
    const glm::vec3 slide = direction / std::max(cosine, min_cosine);
    return {size * (right + slide * glm::dot(point.geometric, right)),
            -size * (up + slide * glm::dot(point.geometric, up)), 0.0f, spacing == 1.0f};
}

RayFootprint make_cone_footprint(const SurfacePoint& point, const glm::vec3& direction, float distance,
                                 float solid_angle) {
    const float cosine = -glm::dot(point.geometric, direction);
    return {{}, {}, std::sqrt(cone_footprint_area(cosine, distance, solid_angle))};
}

float cone_footprint_area(float cosine, float distance, float solid_angle) {
    constexpr float min_cosine = 0.05f;  // the texture of a cone need not be sharp
    return distance * distance * solid_angle / std::max(cosine, min_cosine);
}

UvFootprint make_uv_footprint(const SurfacePoint& point, const RayFootprint& footprint, int uv_set) {
    const glm::vec3 &e1 = point.edges[0], &e2 = point.edges[1];
    const glm::vec2 &uv1 = point.uv_edges[uv_set][0], &uv2 = point.uv_edges[uv_set][1];
    if (footprint.width > 0.0f) {
        const float area = glm::length(glm::cross(e1, e2));
        const float scale = footprint.width * std::sqrt(std::abs(uv1.x * uv2.y - uv1.y * uv2.x) / area);
        return {{scale, 0.0f}, {0.0f, scale}, true};
    }
    if (footprint.dx == glm::vec3(0.0f) && footprint.dy == glm::vec3(0.0f)) return {};
    // Coordinates along the edges, by the edges' dual vectors in the triangle's plane. The sign of point.geometric
    // cancels.
    const glm::vec3 across1 = glm::cross(e2, point.geometric), across2 = glm::cross(point.geometric, e1);
    const float scale1 = 1.0f / glm::dot(e1, across1), scale2 = 1.0f / glm::dot(e2, across2);
    const auto to_uv = [&](const glm::vec3& d) {
        return uv1 * (glm::dot(d, across1) * scale1) + uv2 * (glm::dot(d, across2) * scale2);
    };
    return {to_uv(footprint.dx), to_uv(footprint.dy), false};
}

}  // namespace aleph
