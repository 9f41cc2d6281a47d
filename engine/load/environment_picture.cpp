#include "engine/load/environment_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/color.h"

namespace aleph {

namespace {

bool is_texture(const Scene& scene, int image) {
    return std::ranges::any_of(scene.materials, [&](const Material& material) {
        return std::ranges::any_of(material.textures.all,
                                   [&](const TextureRef& texture) { return texture.image == image; });
    });
}

std::string unused_name(const Scene& scene, const std::string& name) {
    const auto is_used = [&](const std::string& candidate) {
        return std::ranges::any_of(scene.images, [&](const SceneImage& image) { return image.name == candidate; });
    };
    std::string candidate = name;
    for (int i = 2; is_used(candidate); ++i) candidate = fmt::format("{} {}", name, i);
    return candidate;
}

Image<glm::vec4> to_linear(const Image<glm::u8vec4>& bytes) {
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    Image<glm::vec4> floats(bytes.width, bytes.height);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const glm::u8vec4& c = bytes.pixels[i];
        floats.pixels[i] = {linear[c.x], linear[c.y], linear[c.z], static_cast<float>(c.w) / 255.0f};
    }
    return floats;
}

}  // namespace

void make_environment_linear(Scene& scene) {
    if (scene.environment.image == no_index) return;
    const SceneImage& picture = scene.images[scene.environment.image];
    if (picture.bytes.empty()) return;
    if (is_texture(scene, scene.environment.image)) {
        SceneImage copy = picture;
        copy.name = unused_name(scene, copy.name);
        scene.environment.image = static_cast<int>(scene.images.size());
        scene.images.push_back(std::move(copy));
    }
    SceneImage& own = scene.images[scene.environment.image];
    own.floats = to_linear(own.bytes);
    own.bytes = {};
}

}  // namespace aleph
