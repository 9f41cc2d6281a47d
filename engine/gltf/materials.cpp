// glTF reader: materials with their extensions.
#include <fmt/format.h>

#include <algorithm>

#include "engine/gltf/reader.h"
#include "engine/gltf/textures.h"
#include "engine/gltf/validate/material_table.h"

namespace aleph {

namespace {

/// The object that has an owner's properties; null where a material lacks it.
const nlohmann::json* find_owner(const nlohmann::json& material, std::string_view name) {
    const auto find = [](const nlohmann::json* in, std::string_view key) -> const nlohmann::json* {
        if (in == nullptr) return nullptr;
        const auto found = in->find(key);
        return found == in->end() ? nullptr : &*found;
    };
    if (name.empty()) return &material;
    return find(is_gltf_extension(name) ? find(&material, "extensions") : &material, name);
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
        } else {
            const double number = found->get<double>();
            factor.number(material) = factor.takes_zero && number == 0.0 ? 0.0 : clamped(number, factor);
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
    Material material = make_gltf_material();
    material.name = source.name.empty() ? fmt::format("material{}", index) : source.name;
    material.double_sided = source.doubleSided;
    if (source.alphaMode == "MASK") material.opacity.mode = Opacity::Mode::mask;
    if (source.alphaMode == "BLEND") material.opacity.mode = Opacity::Mode::blend;
    material.opacity.cutoff = raw.value("alphaCutoff", 0.5);
    material.unlit = find_owner(raw, "KHR_materials_unlit") != nullptr;
    for (const char* const name : gltf_material_owners())
        if (const nlohmann::json* const owner = find_owner(raw, name)) read_owner(name, *owner, material);
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
        reader.part.materials.push_back(make_gltf_material());
        reader.part.materials.back().name = "default";
    }
    return reader.default_material;
}

}  // namespace aleph
