#include "engine/gltf/write/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

std::uint8_t to_byte(float value, bool is_color) {
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    return static_cast<std::uint8_t>(std::lround(255.0f * (is_color ? linear_to_srgb(clamped) : clamped)));
}

Image<glm::u8vec4> to_bytes(const Image<glm::vec4>& floats, bool is_color) {
    Image<glm::u8vec4> bytes(floats.width, floats.height);
    for (std::size_t i = 0; i < floats.size(); ++i) {
        const glm::vec4& texel = floats.pixels[i];
        bytes.pixels[i] = {to_byte(texel.x, is_color), to_byte(texel.y, is_color), to_byte(texel.z, is_color),
                           to_byte(texel.w, false)};
    }
    return bytes;
}

int wrap_mode(Wrap wrap) {
    return wrap == Wrap::clamp ? 33071 : wrap == Wrap::mirror ? 33648 : 10497;
}

}  // namespace

int TextureWriter::write_image(int index, bool is_color) {
    const SceneImage& image = writer_.scene.images[index];
    const bool has_floats = image.bytes.empty();
    const auto [known, is_new] = images_.emplace(std::pair(index, has_floats && is_color), 0);
    if (!is_new) return known->second;
    if (has_floats) {
        writer_.warnings.push_back(fmt::format("the floats of picture \"{}\" become 8 bits a channel, clamped to 1",
                                               printable(image.path.empty() ? image.name : image.path)));
    }
    const std::string png = has_floats ? encode_png(to_bytes(image.floats, is_color)) : encode_png(image.bytes);
    OrderedJson written;
    if (!image.name.empty()) written["name"] = image.name;
    written["mimeType"] = "image/png";
    written["bufferView"] = writer_.buffer.add_view(png.data(), png.size());
    return known->second = writer_.add("images", std::move(written));
}

int TextureWriter::write_sampler(const TextureRef& texture) {
    const OrderedJson sampler = {{"magFilter", texture.nearest ? 9728 : 9729},
                                 {"minFilter", 9987},
                                 {"wrapS", wrap_mode(texture.wrap_u)},
                                 {"wrapT", wrap_mode(texture.wrap_v)}};
    const auto [known, is_new] = samplers_.emplace(sampler, 0);
    if (is_new) known->second = writer_.add("samplers", sampler);
    return known->second;
}

int TextureWriter::write_texture(int image, int sampler) {
    const auto [known, is_new] = textures_.emplace(std::pair(image, sampler), 0);
    if (is_new) known->second = writer_.add("textures", {{"sampler", sampler}, {"source", image}});
    return known->second;
}

void TextureWriter::write(OrderedJson& owner, const char* key, const Material& material, TextureSlot slot,
                          double scale) {
    const TextureRef& texture = material.textures[slot];
    if (texture.image == no_index) return;
    const int image = write_image(texture.image, is_color(slot));
    OrderedJson& info = owner[key];
    info["index"] = write_texture(image, write_sampler(texture));
    if (texture.uv_set != 0) info["texCoord"] = texture.uv_set;
    if (scale != 1.0) info["scale"] = scale;
    const TextureRef still;
    if (texture.uv_offset == still.uv_offset && texture.uv_scale == still.uv_scale && texture.uv_rotation == 0.0)
        return;
    OrderedJson& transform = writer_.extend(info, "KHR_texture_transform");
    transform["offset"] = OrderedJson::array({texture.uv_offset.x, texture.uv_offset.y});
    transform["rotation"] = texture.uv_rotation;
    transform["scale"] = OrderedJson::array({texture.uv_scale.x, texture.uv_scale.y});
}

}  // namespace aleph
