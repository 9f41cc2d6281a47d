// glTF reader: materials with their extensions.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/gltf/reader.h"
#include "engine/gltf/textures.h"

namespace aleph {

namespace {

constexpr double unlimited = std::numeric_limits<double>::max();

/// Reads materials. Factors out of range are clamped, with a warning.
class MaterialReader {
  public:
    explicit MaterialReader(GltfReader& reader) : reader_(reader), textures_(reader) {}

    Material read(std::size_t index);

  private:
    double clamped(double value, double low, double high, const char* name);
    double number(const nlohmann::json& owner, const char* key, double absent, double high = 1.0);
    glm::dvec3 clamped(const glm::dvec3& value, double high, const char* name);
    glm::dvec3 color(const nlohmann::json& owner, const char* key, double absent, double high = 1.0);
    void read_core(const tinygltf::Material& source, const nlohmann::json& raw, Material& material);
    void read_base_extensions(const nlohmann::json& extensions, Material& material);
    void read_volume(const nlohmann::json& volume, Material& material);
    void read_clearcoat(const nlohmann::json& coat, Material& material);
    void read_sheen(const nlohmann::json& sheen, Material& material);
    void read_anisotropy(const nlohmann::json& anisotropy, Material& material);

    GltfReader& reader_;
    GltfTextures textures_;
    std::string place_;  ///< of the material that is read
};

double MaterialReader::clamped(double value, double low, double high, const char* name) {
    const double inside = std::clamp(value, low, high);
    if (inside != value) reader_.warn(place_, fmt::format("{} {} is clamped to {}", name, value, inside));
    return inside;
}

double MaterialReader::number(const nlohmann::json& owner, const char* key, double absent, double high) {
    return clamped(owner.value(key, absent), 0.0, high, key);
}

glm::dvec3 MaterialReader::clamped(const glm::dvec3& value, double high, const char* name) {
    return {clamped(value.x, 0.0, high, name), clamped(value.y, 0.0, high, name), clamped(value.z, 0.0, high, name)};
}

glm::dvec3 MaterialReader::color(const nlohmann::json& owner, const char* key, double absent, double high) {
    const auto found = owner.find(key);
    if (found == owner.end()) return glm::dvec3(absent);
    return clamped({(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()}, high, key);
}

/// The factor on x and y of a normal map.
double normal_scale(const nlohmann::json& owner, const char* key) {
    const auto info = owner.find(key);
    return info == owner.end() ? 1.0 : info->value("scale", 1.0);
}

void MaterialReader::read_base_extensions(const nlohmann::json& extensions, Material& material) {
    if (const auto found = extensions.find("KHR_materials_emissive_strength"); found != extensions.end()) {
        material.glow.strength = number(*found, "emissiveStrength", 1.0, unlimited);
    }
    if (const auto found = extensions.find("KHR_materials_ior"); found != extensions.end()) {
        const double ior = found->value("ior", 1.5);
        material.gloss.ior = ior == 0.0 ? 0.0 : clamped(ior, 1.0, unlimited, "ior");  // 0 is allowed: full reflection
    }
    material.unlit = extensions.contains("KHR_materials_unlit");
    if (const auto found = extensions.find("KHR_materials_transmission"); found != extensions.end()) {
        material.glass.transmission = number(*found, "transmissionFactor", 0.0);
        material.textures[TextureSlot::transmission] = textures_.read(*found, "transmissionTexture");
    }
    if (const auto found = extensions.find("KHR_materials_specular"); found != extensions.end()) {
        material.gloss.specular = number(*found, "specularFactor", 1.0);
        material.gloss.specular_color = color(*found, "specularColorFactor", 1.0, unlimited);
        material.textures[TextureSlot::specular] = textures_.read(*found, "specularTexture");
        material.textures[TextureSlot::specular_color] = textures_.read(*found, "specularColorTexture");
    }
}

void MaterialReader::read_volume(const nlohmann::json& volume, Material& material) {
    material.glass.thickness = number(volume, "thicknessFactor", 0.0, unlimited);
    material.textures[TextureSlot::thickness] = textures_.read(volume, "thicknessTexture");
    material.glass.attenuation_distance = volume.value("attenuationDistance", 0.0);  // glTF: infinite where absent
    material.glass.attenuation_color = color(volume, "attenuationColor", 1.0);
}

void MaterialReader::read_clearcoat(const nlohmann::json& coat, Material& material) {
    material.layers.clearcoat = number(coat, "clearcoatFactor", 0.0);
    material.textures[TextureSlot::clearcoat] = textures_.read(coat, "clearcoatTexture");
    material.layers.clearcoat_roughness = number(coat, "clearcoatRoughnessFactor", 0.0);
    material.textures[TextureSlot::clearcoat_roughness] = textures_.read(coat, "clearcoatRoughnessTexture");
    material.textures[TextureSlot::clearcoat_normal] = textures_.read(coat, "clearcoatNormalTexture");
    material.textures.clearcoat_normal_scale = normal_scale(coat, "clearcoatNormalTexture");
}

void MaterialReader::read_sheen(const nlohmann::json& sheen, Material& material) {
    material.layers.sheen_color = color(sheen, "sheenColorFactor", 0.0);
    material.textures[TextureSlot::sheen_color] = textures_.read(sheen, "sheenColorTexture");
    material.layers.sheen_roughness = number(sheen, "sheenRoughnessFactor", 0.0);
    material.textures[TextureSlot::sheen_roughness] = textures_.read(sheen, "sheenRoughnessTexture");
}

void MaterialReader::read_anisotropy(const nlohmann::json& anisotropy, Material& material) {
    material.layers.anisotropy = number(anisotropy, "anisotropyStrength", 0.0);
    material.layers.anisotropy_rotation = anisotropy.value("anisotropyRotation", 0.0);
    material.textures[TextureSlot::anisotropy] = textures_.read(anisotropy, "anisotropyTexture");
}

void MaterialReader::read_core(const tinygltf::Material& source, const nlohmann::json& raw, Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const std::vector<double>& base = pbr.baseColorFactor;
    material.base_color = clamped({base[0], base[1], base[2]}, 1.0, "baseColorFactor");
    material.opacity.alpha = clamped(base[3], 0.0, 1.0, "baseColorFactor");
    material.gloss.metallic = clamped(pbr.metallicFactor, 0.0, 1.0, "metallicFactor");
    material.gloss.roughness = clamped(pbr.roughnessFactor, 0.0, 1.0, "roughnessFactor");
    if (const auto found = raw.find("pbrMetallicRoughness"); found != raw.end()) {
        material.textures[TextureSlot::base_color] = textures_.read(*found, "baseColorTexture");
        material.textures[TextureSlot::metallic_roughness] = textures_.read(*found, "metallicRoughnessTexture");
    }
    material.textures[TextureSlot::normal] = textures_.read(raw, "normalTexture");
    material.textures.normal_scale = normal_scale(raw, "normalTexture");
    const std::vector<double>& emission = source.emissiveFactor;
    material.glow.color = clamped({emission[0], emission[1], emission[2]}, 1.0, "emissiveFactor");
    material.textures[TextureSlot::emission] = textures_.read(raw, "emissiveTexture");
    material.double_sided = source.doubleSided;
    if (source.alphaMode == "MASK") material.opacity.mode = Opacity::Mode::mask;
    if (source.alphaMode == "BLEND") material.opacity.mode = Opacity::Mode::blend;
    material.opacity.cutoff = raw.value("alphaCutoff", 0.5);
}

Material MaterialReader::read(std::size_t index) {
    const tinygltf::Material& source = reader_.source.model.materials[index];
    const nlohmann::json& raw = reader_.source.document["materials"][index];
    place_ = fmt::format("/materials/{}", index);
    Material material;
    material.name = source.name.empty() ? fmt::format("material{}", index) : source.name;
    read_core(source, raw, material);
    const auto extensions = raw.find("extensions");
    if (extensions == raw.end()) return material;
    read_base_extensions(*extensions, material);
    const auto read_one = [&](const char* name, void (MaterialReader::*part)(const nlohmann::json&, Material&)) {
        if (const auto found = extensions->find(name); found != extensions->end()) (this->*part)(*found, material);
    };
    read_one("KHR_materials_volume", &MaterialReader::read_volume);
    read_one("KHR_materials_clearcoat", &MaterialReader::read_clearcoat);
    read_one("KHR_materials_sheen", &MaterialReader::read_sheen);
    read_one("KHR_materials_anisotropy", &MaterialReader::read_anisotropy);
    return material;
}

}  // namespace

void read_materials(GltfReader& reader) {
    MaterialReader materials(reader);
    std::size_t with_occlusion = 0;
    for (std::size_t i = 0; i < reader.source.model.materials.size(); ++i) {
        reader.part.materials.push_back(materials.read(i));
        if (reader.source.model.materials[i].occlusionTexture.index >= 0) ++with_occlusion;
    }
    if (with_occlusion > 0) {
        reader.warn("materials", fmt::format("occlusion textures ({}) are not used", with_occlusion));
    }
}

int default_material(GltfReader& reader) {
    if (reader.default_material == no_index) {
        reader.default_material = static_cast<int>(reader.part.materials.size());
        reader.part.materials.push_back({.name = "default", .gloss = {.metallic = 1.0}});
    }
    return reader.default_material;
}

}  // namespace aleph
