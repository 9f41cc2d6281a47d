#include "render/texture.h"

#include <array>
#include <cmath>

#include "engine/base/color.h"

namespace aleph {

namespace {

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
        return t;
    }();
    return table;
}

int wrap_index(int i, int n, Wrap wrap) {
    if (wrap == Wrap::clamp) return i < 0 ? 0 : (i >= n ? n - 1 : i);
    if (wrap == Wrap::repeat) {
        const int r = i % n;
        return r < 0 ? r + n : r;
    }
    const int period = 2 * n;
    int r = i % period;
    if (r < 0) r += period;
    return r < n ? r : period - 1 - r;
}

glm::vec4 read_texel(const SceneImage& image, int x, int y, TextureSpace space) {
    if (image.bytes.empty()) return image.floats(x, y);
    const glm::u8vec4 b = image.bytes(x, y);
    const auto decode = [&](std::uint8_t v) {
        return space == TextureSpace::srgb ? srgb_table()[v] : static_cast<float>(v) * (1.0f / 255.0f);
    };
    return {decode(b.x), decode(b.y), decode(b.z), static_cast<float>(b.w) * (1.0f / 255.0f)};
}

}  // namespace

glm::vec4 sample_texture(const Scene& scene, const TextureRef& texture, const glm::vec2& uv, TextureSpace space) {
    if (texture.image == no_index) return glm::vec4(1.0f);
    const SceneImage& image = scene.images[static_cast<std::size_t>(texture.image)];
    const int width = image.bytes.empty() ? image.floats.width : image.bytes.width;
    const int height = image.bytes.empty() ? image.floats.height : image.bytes.height;
    if (width == 0 || height == 0) return glm::vec4(1.0f);
    // Far beyond this a float holds no fraction of a texel, and the conversion to int would overflow.
    constexpr float limit = 1e6f;
    const float u = std::abs(uv.x) < limit ? uv.x : 0.0f;
    const float v = std::abs(uv.y) < limit ? uv.y : 0.0f;
    // Wrap before scaling, so that indices stay small whatever the repeat count; mirroring has period 2.
    const float fx = (u - 2.0f * std::floor(u * 0.5f)) * static_cast<float>(width);
    const float fy = (v - 2.0f * std::floor(v * 0.5f)) * static_cast<float>(height);
    const float px = texture.wrap_u == Wrap::clamp ? glm::clamp(u, 0.0f, 1.0f) * static_cast<float>(width) : fx;
    const float py = texture.wrap_v == Wrap::clamp ? glm::clamp(v, 0.0f, 1.0f) * static_cast<float>(height) : fy;
    const auto texel = [&](int x, int y) {
        return read_texel(image, wrap_index(x, width, texture.wrap_u), wrap_index(y, height, texture.wrap_v), space);
    };
    if (texture.nearest) return texel(static_cast<int>(std::floor(px)), static_cast<int>(std::floor(py)));
    const float cx = px - 0.5f, cy = py - 0.5f;
    const float x0 = std::floor(cx), y0 = std::floor(cy);
    const float ax = cx - x0, ay = cy - y0;
    const int ix = static_cast<int>(x0), iy = static_cast<int>(y0);
    const glm::vec4 top = texel(ix, iy) * (1.0f - ax) + texel(ix + 1, iy) * ax;
    const glm::vec4 bottom = texel(ix, iy + 1) * (1.0f - ax) + texel(ix + 1, iy + 1) * ax;
    return top * (1.0f - ay) + bottom * ay;
}

}  // namespace aleph
