// glTF writer: materials with their extensions.
#include <algorithm>
#include <array>

#include "engine/gltf/write/textures.h"
#include "engine/gltf/write/writer.h"

namespace aleph {

namespace {

class MaterialWriter {
  public:
    explicit MaterialWriter(GltfWriter& writer) : writer_(writer), textures_(writer) {}

    int write(const Material& material);

  private:
    void write_core(const Material& material, OrderedJson& written);
    void write_base_color(const Material& material, OrderedJson& pbr);
    void write_emission(const Material& material, OrderedJson& written);
    void write_gloss(const Material& material, OrderedJson& written);
    void write_glass(const Material& material, OrderedJson& written);
    void write_layers(const Material& material, OrderedJson& written);

    /// An extension of the material, if any of its properties differs from what its absence means.
    template <class Write>
    void extend(OrderedJson& written, const char* extension, bool is_needed, const Write& write) {
        if (!is_needed) return;
        extension_ = place_ + "/extensions/" + extension;
        write(writer_.extend(written, extension));
    }

    /// Writes a factor, and its keys if it changes.
    /// @param owner  whose place in the file is `place`
    template <class T>
    void factor(OrderedJson& owner, const std::string& place, const char* key, const Track<T>& track) {
        owner[key] = key_value(track, 0);
        if (is_animated(track)) writer_.animate(place + "/" + key, writer_.keys_of(track, place_));
    }
    void factor(OrderedJson& owner, const std::string& place, const char* key, const Track<glm::dvec3>& track) {
        owner[key] = to_json(key_value(track, 0));
        if (is_animated(track)) writer_.animate(place + "/" + key, writer_.keys_of(track, place_));
    }

    GltfWriter& writer_;
    TextureWriter textures_;
    std::string place_;      ///< of the material, as a JSON pointer
    std::string extension_;  ///< of the extension that is written
};

/// True where the track is not that value at all times.
template <class T>
bool differs(const Track<T>& track, const T& value) {
    return is_animated(track) || key_value(track, 0) != value;
}

bool has(const Material& material, TextureSlot slot) {
    return material.textures[slot].image != no_index;
}

void MaterialWriter::write_base_color(const Material& material, OrderedJson& pbr) {
    const Track<glm::dvec3>& color = material.base_color;
    const Track<double>& alpha = material.opacity.alpha;
    const auto row = [](const glm::dvec3& c, double a) { return std::array{c.x, c.y, c.z, a}; };
    pbr["baseColorFactor"] = row(key_value(color, 0), key_value(alpha, 0));
    if (!is_animated(color) && !is_animated(alpha)) return;
    std::array<KeyColumn, 2> columns;
    const glm::dvec3& first = key_value(color, 0);
    columns[0].constant = {first.x, first.y, first.z};
    columns[1].constant = {key_value(alpha, 0)};
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
    writer_.animate(place_ + "/pbrMetallicRoughness/baseColorFactor", *keys);
}

void MaterialWriter::write_emission(const Material& material, OrderedJson& written) {
    Track<glm::dvec3> color = material.glow.color;
    if (!differs(color, glm::dvec3(0.0))) return;
    // The factor of glTF is at most 1; the strength holds the rest.
    Track<double> strength = material.glow.strength;
    const double excess = scale_to_one(color);
    for (double& value : strength.values) value *= excess;
    factor(written, place_, "emissiveFactor", color);
    extend(written, "KHR_materials_emissive_strength", differs(strength, 1.0),
           [&](OrderedJson& extension) { factor(extension, extension_, "emissiveStrength", strength); });
}

void MaterialWriter::write_core(const Material& material, OrderedJson& written) {
    OrderedJson& pbr = written["pbrMetallicRoughness"];
    write_base_color(material, pbr);
    const std::string place = place_ + "/pbrMetallicRoughness";
    factor(pbr, place, "metallicFactor", material.gloss.metallic);
    factor(pbr, place, "roughnessFactor", material.gloss.roughness);
    textures_.write(pbr, "baseColorTexture", material, TextureSlot::base_color);
    textures_.write(pbr, "metallicRoughnessTexture", material, TextureSlot::metallic_roughness);
    textures_.write(written, "normalTexture", material, TextureSlot::normal, material.textures.normal_scale);
    write_emission(material, written);
    textures_.write(written, "emissiveTexture", material, TextureSlot::emission);
    if (material.opacity.mode == Opacity::Mode::blend) written["alphaMode"] = "BLEND";
    if (material.opacity.mode == Opacity::Mode::mask) {
        written["alphaMode"] = "MASK";
        written["alphaCutoff"] = material.opacity.cutoff;
    }
    if (material.double_sided) written["doubleSided"] = true;
}

void MaterialWriter::write_gloss(const Material& material, OrderedJson& written) {
    const Gloss& gloss = material.gloss;
    extend(written, "KHR_materials_ior", differs(gloss.ior, 1.5),
           [&](OrderedJson& extension) { factor(extension, extension_, "ior", gloss.ior); });
    const bool is_needed = differs(gloss.specular, 1.0) || differs(gloss.specular_color, glm::dvec3(1.0)) ||
                           has(material, TextureSlot::specular) || has(material, TextureSlot::specular_color);
    extend(written, "KHR_materials_specular", is_needed, [&](OrderedJson& extension) {
        factor(extension, extension_, "specularFactor", gloss.specular);
        factor(extension, extension_, "specularColorFactor", gloss.specular_color);
        textures_.write(extension, "specularTexture", material, TextureSlot::specular);
        textures_.write(extension, "specularColorTexture", material, TextureSlot::specular_color);
    });
}

void MaterialWriter::write_glass(const Material& material, OrderedJson& written) {
    const Glass& glass = material.glass;
    const bool transmits = differs(glass.transmission, 0.0) || has(material, TextureSlot::transmission);
    extend(written, "KHR_materials_transmission", transmits, [&](OrderedJson& extension) {
        factor(extension, extension_, "transmissionFactor", glass.transmission);
        textures_.write(extension, "transmissionTexture", material, TextureSlot::transmission);
    });
    const bool has_volume = differs(glass.thickness, 0.0) || has(material, TextureSlot::thickness) ||
                            differs(glass.attenuation_distance, 0.0) ||
                            differs(glass.attenuation_color, glm::dvec3(1.0));
    extend(written, "KHR_materials_volume", has_volume, [&](OrderedJson& extension) {
        factor(extension, extension_, "thicknessFactor", glass.thickness);
        textures_.write(extension, "thicknessTexture", material, TextureSlot::thickness);
        // 0 stands for no attenuation: in glTF, an infinite distance.
        constexpr double endless = 1e30;
        Track<double> distance = glass.attenuation_distance;
        for (double& value : distance.values)
            if (distance.interpolation != Interpolation::cubic && !(value > 0.0)) value = endless;
        if (differs(glass.attenuation_distance, 0.0)) factor(extension, extension_, "attenuationDistance", distance);
        factor(extension, extension_, "attenuationColor", glass.attenuation_color);
    });
}

void MaterialWriter::write_layers(const Material& material, OrderedJson& written) {
    const Layers& layers = material.layers;
    const bool has_coat = differs(layers.clearcoat, 0.0) || has(material, TextureSlot::clearcoat);
    extend(written, "KHR_materials_clearcoat", has_coat, [&](OrderedJson& extension) {
        factor(extension, extension_, "clearcoatFactor", layers.clearcoat);
        factor(extension, extension_, "clearcoatRoughnessFactor", layers.clearcoat_roughness);
        textures_.write(extension, "clearcoatTexture", material, TextureSlot::clearcoat);
        textures_.write(extension, "clearcoatRoughnessTexture", material, TextureSlot::clearcoat_roughness);
        textures_.write(extension, "clearcoatNormalTexture", material, TextureSlot::clearcoat_normal,
                        material.textures.clearcoat_normal_scale);
    });
    const bool has_sheen = differs(layers.sheen_color, glm::dvec3(0.0)) || has(material, TextureSlot::sheen_color);
    extend(written, "KHR_materials_sheen", has_sheen, [&](OrderedJson& extension) {
        factor(extension, extension_, "sheenColorFactor", layers.sheen_color);
        factor(extension, extension_, "sheenRoughnessFactor", layers.sheen_roughness);
        textures_.write(extension, "sheenColorTexture", material, TextureSlot::sheen_color);
        textures_.write(extension, "sheenRoughnessTexture", material, TextureSlot::sheen_roughness);
    });
    const bool is_anisotropic = differs(layers.anisotropy, 0.0) || has(material, TextureSlot::anisotropy);
    extend(written, "KHR_materials_anisotropy", is_anisotropic, [&](OrderedJson& extension) {
        factor(extension, extension_, "anisotropyStrength", layers.anisotropy);
        factor(extension, extension_, "anisotropyRotation", layers.anisotropy_rotation);
        textures_.write(extension, "anisotropyTexture", material, TextureSlot::anisotropy);
    });
}

int MaterialWriter::write(const Material& material) {
    const std::size_t index = writer_.document.contains("materials") ? writer_.document["materials"].size() : 0;
    place_ = "/materials/" + std::to_string(index);
    OrderedJson written;
    if (!material.name.empty()) written["name"] = material.name;
    write_core(material, written);
    write_gloss(material, written);
    write_glass(material, written);
    write_layers(material, written);
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
