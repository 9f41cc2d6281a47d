// glTF writer: materials with their extensions; their textures, samplers and images.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/gltf/validate/material_table.h"
#include "engine/gltf/write/writer.h"
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

/// Textures, samplers and images are written once.
class MaterialWriter {
  public:
    explicit MaterialWriter(GltfWriter& writer) : writer_(writer) {}

    int write(const Material& material);

  private:
    void write_owner(const char* name, const Material& material, OrderedJson& owner);
    void write_base_color(const Material& material, OrderedJson& core);
    void write_texture(OrderedJson& owner, const GltfTexture& row, const Material& material);
    int write_image(int image, bool is_color);
    int write_sampler(const TextureRef& texture);
    int add_texture(int image, int sampler);

    template <class T>
    void write_factor(OrderedJson& owner, const char* key, const Track<T>& track) {
        if constexpr (std::is_same_v<T, double>) {
            owner[key] = first_value(track);
        } else {
            owner[key] = to_json(first_value(track));
        }
        if (is_animated(track)) writer_.animate(owner_place_ + key, writer_.keys_of(track, place_));
    }

    GltfWriter& writer_;
    std::string place_;                           ///< of the material, as a JSON pointer
    std::string owner_place_;                     ///< of the object that is written, with a slash behind it
    std::map<std::pair<int, bool>, int> images_;  ///< scene image, and whether its floats are encoded as colours
    std::map<OrderedJson, int> samplers_;
    std::map<std::pair<int, int>, int> textures_;
};

/// True where the track is not that value at all times.
template <class T>
bool differs(const Track<T>& track, const T& value) {
    return is_animated(track) || key_value(track, 0) != value;
}

bool is_needed(const GltfFactor& factor, const Material& material) {
    static const Material absent = make_gltf_material();
    if (factor.has_alpha && differs(material.opacity.alpha, 1.0)) return true;
    return factor.is_color() ? differs(factor.color(material), key_value(factor.color(absent), 0))
                             : differs(factor.number(material), key_value(factor.number(absent), 0));
}

/// Returns whether something of an object differs from what its absence means.
bool is_needed(const char* owner, const Material& material) {
    bool needed = false;
    for_each_of(gltf_factors(), owner, [&](const GltfFactor& factor) { needed |= is_needed(factor, material); });
    for_each_of(gltf_textures(), owner,
                [&](const GltfTexture& texture) { needed |= material.textures[texture.slot].image != no_index; });
    return needed;
}

/// The material as glTF can say it.
Material adapt(Material material) {
    // The factor of glTF is at most 1; the strength holds the rest.
    Glow& glow = material.glow;
    if (!differs(glow.color, glm::dvec3(0.0))) glow = {};
    const double excess = scale_to_one(glow.color);
    for (double& value : glow.strength.values) value *= excess;
    // A distance of 0 stands for no attenuation: in glTF, an infinite one.
    constexpr double endless = 1e9;  // m
    Track<double>& distance = material.glass.attenuation_distance;
    for (double& value : distance.values)
        if (is_animated(distance) && distance.interpolation != Interpolation::cubic && !(value > 0.0)) value = endless;
    return material;
}

int MaterialWriter::write_image(int index, bool is_color) {
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

int MaterialWriter::write_sampler(const TextureRef& texture) {
    const OrderedJson sampler = {{"magFilter", texture.nearest ? 9728 : 9729},
                                 {"minFilter", 9987},
                                 {"wrapS", wrap_mode(texture.wrap_u)},
                                 {"wrapT", wrap_mode(texture.wrap_v)}};
    const auto [known, is_new] = samplers_.emplace(sampler, 0);
    if (is_new) known->second = writer_.add("samplers", sampler);
    return known->second;
}

int MaterialWriter::add_texture(int image, int sampler) {
    const auto [known, is_new] = textures_.emplace(std::pair(image, sampler), 0);
    if (is_new) known->second = writer_.add("textures", {{"sampler", sampler}, {"source", image}});
    return known->second;
}

void MaterialWriter::write_texture(OrderedJson& owner, const GltfTexture& row, const Material& material) {
    const TextureRef& texture = material.textures[row.slot];
    if (texture.image == no_index) return;
    const int image = write_image(texture.image, is_color(row.slot));
    OrderedJson& info = owner[row.key];
    info["index"] = add_texture(image, write_sampler(texture));
    if (texture.uv_set != 0) info["texCoord"] = texture.uv_set;
    const double scale = row.scale != nullptr ? material.textures.*row.scale : 1.0;
    if (scale != 1.0) info["scale"] = scale;
    const TextureRef still;
    if (texture.uv_offset == still.uv_offset && texture.uv_scale == still.uv_scale && texture.uv_rotation == 0.0)
        return;
    OrderedJson& transform = writer_.extend(info, "KHR_texture_transform");
    transform["offset"] = OrderedJson::array({texture.uv_offset.x, texture.uv_offset.y});
    transform["rotation"] = texture.uv_rotation;
    transform["scale"] = OrderedJson::array({texture.uv_scale.x, texture.uv_scale.y});
}

void MaterialWriter::write_base_color(const Material& material, OrderedJson& core) {
    const Track<glm::dvec3>& color = material.base_color;
    const Track<double>& alpha = material.opacity.alpha;
    const auto row = [](const glm::dvec3& c, double a) { return std::array{c.x, c.y, c.z, a}; };
    core["baseColorFactor"] = row(first_value(color), first_value(alpha));
    if (!is_animated(color) && !is_animated(alpha)) return;
    std::array<KeyColumn, 2> columns;
    const glm::dvec3 first = first_value(color);
    columns[0].constant = {first.x, first.y, first.z};
    columns[1].constant = {first_value(alpha)};
    if (is_animated(color)) columns[0].keys = writer_.keys_of(color, place_);
    if (is_animated(alpha)) columns[1].keys = writer_.keys_of(alpha, place_);
    std::optional<WrittenKeys> keys = join_columns(columns);
    if (!keys) {
        SampledTimes sampled;
        sampled.add(color);
        sampled.add(alpha);
        writer_.add_frames(sampled, place_);
        keys.emplace().row = 4;
        for (const KeyTime& key : sampled.make_key_times())
            keys->append(key.time, row(evaluate(color, key.at), evaluate(alpha, key.at)));
    }
    writer_.animate(owner_place_ + "baseColorFactor", *keys);
}

void MaterialWriter::write_owner(const char* name, const Material& material, OrderedJson& owner) {
    for_each_of(gltf_factors(), name, [&](const GltfFactor& factor) {
        if (!is_needed(factor, material)) return;
        if (factor.has_alpha) return write_base_color(material, owner);
        if (factor.is_color()) {
            write_factor(owner, factor.key, factor.color(material));
        } else {
            write_factor(owner, factor.key, factor.number(material));
        }
    });
    for_each_of(gltf_textures(), name, [&](const GltfTexture& texture) { write_texture(owner, texture, material); });
}

int MaterialWriter::write(const Material& material) {
    const std::size_t index = writer_.document.contains("materials") ? writer_.document["materials"].size() : 0;
    place_ = "/materials/" + std::to_string(index);
    OrderedJson written;
    if (!material.name.empty()) written["name"] = material.name;
    if (material.opacity.mode == Opacity::Mode::blend) written["alphaMode"] = "BLEND";
    if (material.opacity.mode == Opacity::Mode::mask) {
        written["alphaMode"] = "MASK";
        written["alphaCutoff"] = material.opacity.cutoff;
    }
    if (material.double_sided) written["doubleSided"] = true;
    const Material adapted = adapt(material);
    for (const char* const name : gltf_material_owners()) {
        if (!is_needed(name, adapted)) continue;
        owner_place_ = place_ + "/" + gltf_owner_path(name);
        OrderedJson& member = is_gltf_extension(name) ? writer_.extend(written, name)
                              : *name == '\0'         ? written
                                                      : written[name];
        write_owner(name, adapted, member);
    }
    if (material.unlit) writer_.extend(written, "KHR_materials_unlit");
    return writer_.add("materials", std::move(written));
}

}  // namespace

void write_materials(GltfWriter& writer) {
    MaterialWriter materials(writer);
    for (const Material& material : writer.scene.materials) materials.write(material);
}

int material_of(GltfWriter& writer, int material) {
    if (material != no_index) return material;
    if (writer.default_material == no_index) writer.default_material = MaterialWriter(writer).write(Material{});
    return writer.default_material;
}

}  // namespace aleph
