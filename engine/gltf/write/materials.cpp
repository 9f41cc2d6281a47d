// glTF writer: materials with their extensions.
#include <array>
#include <type_traits>

#include "engine/gltf/validate/material_table.h"
#include "engine/gltf/write/textures.h"
#include "engine/gltf/write/writer.h"

namespace aleph {

namespace {

class MaterialWriter {
  public:
    explicit MaterialWriter(GltfWriter& writer) : writer_(writer), textures_(writer) {}

    int write(const Material& material);

  private:
    void write_owner(const char* name, const Material& material, OrderedJson& owner);
    void write_base_color(const Material& material, OrderedJson& core);

    /// Writes a factor, and its keys if it changes.
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
    TextureWriter textures_;
    std::string place_;        ///< of the material, as a JSON pointer
    std::string owner_place_;  ///< of the object that is written, with a slash behind it
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
    for_each_of(gltf_textures(), name, [&](const GltfTexture& texture) {
        const double scale = texture.scale != nullptr ? material.textures.*texture.scale : 1.0;
        textures_.write(owner, texture.key, material, texture.slot, scale);
    });
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
