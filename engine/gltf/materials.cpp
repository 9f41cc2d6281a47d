// glTF reader: materials with their extensions.
#include <fmt/format.h>

#include <algorithm>

#include "engine/gltf/reader.h"
#include "engine/gltf/textures.h"
#include "engine/gltf/validate/material_table.h"

namespace aleph {

namespace {

const Gloss gltf_gloss{.metallic = 1.0};  // where a file says nothing

/// An index of refraction of 0 stands for full reflection.
bool allows_zero(const GltfFactor& factor) {
    return std::string_view(factor.key) == "ior";
}

/// Reads materials. Factors out of range are clamped, with a warning.
class MaterialReader {
  public:
    explicit MaterialReader(GltfReader& reader) : reader_(reader), textures_(reader) {}

    Material read(std::size_t index);

  private:
    double clamped(double value, const GltfFactor& factor);
    void read_owner(const char* name, const nlohmann::json& owner, Material& material);

    GltfReader& reader_;
    GltfTextures textures_;
    std::string place_;  ///< of the material that is read
};

double MaterialReader::clamped(double value, const GltfFactor& factor) {
    const double inside = std::clamp(value, factor.low, factor.high);
    if (inside != value) reader_.warn(place_, fmt::format("{} {} is clamped to {}", factor.key, value, inside));
    return inside;
}

void MaterialReader::read_owner(const char* name, const nlohmann::json& owner, Material& material) {
    for_each_of(gltf_factors(), name, [&](const GltfFactor& factor) {
        const auto found = owner.find(factor.key);
        if (found == owner.end()) return;
        const auto value = [&](int i) { return clamped((*found)[i].get<double>(), factor); };
        if (factor.is_color()) {
            const double r = value(0), g = value(1), b = value(2);
            factor.color(material) = glm::dvec3(r, g, b);
        } else if (const double number = found->get<double>(); number != 0.0 || !allows_zero(factor)) {
            factor.number(material) = clamped(number, factor);
        } else {
            factor.number(material) = 0.0;
        }
        if (factor.has_alpha) material.opacity.alpha = value(3);
    });
    for_each_of(gltf_textures(), name, [&](const GltfTexture& texture) {
        material.textures[texture.slot] = textures_.read(owner, texture.key);
        const auto info = owner.find(texture.key);
        if (info != owner.end() && texture.scale != nullptr)
            material.textures.*texture.scale = info->value("scale", 1.0);
    });
}

Material MaterialReader::read(std::size_t index) {
    const tinygltf::Material& source = reader_.source.model.materials[index];
    const nlohmann::json& raw = reader_.source.document["materials"][index];
    place_ = fmt::format("/materials/{}", index);
    Material material{.gloss = gltf_gloss};
    material.name = source.name.empty() ? fmt::format("material{}", index) : source.name;
    material.double_sided = source.doubleSided;
    if (source.alphaMode == "MASK") material.opacity.mode = Opacity::Mode::mask;
    if (source.alphaMode == "BLEND") material.opacity.mode = Opacity::Mode::blend;
    material.opacity.cutoff = raw.value("alphaCutoff", 0.5);
    const nlohmann::json extensions = raw.value("extensions", nlohmann::json::object());
    material.unlit = extensions.contains("KHR_materials_unlit");
    for (const char* const name : gltf_material_owners()) {
        if (*name == '\0') read_owner(name, raw, material);
        const nlohmann::json& members = is_gltf_extension(name) ? extensions : raw;
        if (const auto found = members.find(name); found != members.end()) read_owner(name, *found, material);
    }
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
        reader.part.materials.push_back({.name = "default", .gloss = gltf_gloss});
    }
    return reader.default_material;
}

}  // namespace aleph
