// Images, textures and materials of a .glb.

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tests/engine/gltf/glb_parts.h"
#include "tests/support/read_bytes.h"

namespace aleph {

void GlbWriter::add_images() {
    for (const SceneImage& source : scene_.images) {
        if (source.path.empty()) refuse("embedded images");
        const auto path = std::filesystem::path(scene_.source.file).parent_path() / source.path;
        const std::string bytes = read_bytes(path);
        if (bytes.substr(1, 3) != "PNG") refuse(path.string());
        gltf::Image image;
        image.name = source.name;
        image.mimeType = "image/png";
        image.bufferView = add_view(bytes.data(), bytes.size());
        model_.images.push_back(image);
    }
}

int GlbWriter::texture_of(const TextureRef& reference) {
    const auto wrap = [](Wrap mode) {
        return mode == Wrap::repeat  ? TINYGLTF_TEXTURE_WRAP_REPEAT
               : mode == Wrap::clamp ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
                                     : TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    };
    if (reference.uv_offset != glm::dvec2(0.0) || reference.uv_scale != glm::dvec2(1.0)) refuse("moved textures");
    gltf::Sampler sampler;
    sampler.wrapS = wrap(reference.wrap_u);
    sampler.wrapT = wrap(reference.wrap_v);
    if (reference.nearest) sampler.magFilter = TINYGLTF_TEXTURE_FILTER_NEAREST;
    gltf::Texture texture;
    texture.sampler = static_cast<int>(model_.samplers.size());
    texture.source = reference.image;
    model_.samplers.push_back(sampler);
    model_.textures.push_back(texture);
    return static_cast<int>(model_.textures.size()) - 1;
}

gltf::Value GlbWriter::texture_info(const TextureRef& reference, double scale) {
    const int texture = texture_of(reference);
    gltf::Value::Object info{{"index", gltf::Value(texture)}, {"texCoord", gltf::Value(reference.uv_set)}};
    if (scale != 1.0) info["scale"] = gltf::Value(scale);
    return gltf::Value(std::move(info));
}

void GlbWriter::add_texture(gltf::Value::Object& members, const char* key, const TextureRef& reference, double scale) {
    if (reference.image != no_index) members[key] = texture_info(reference, scale);
}

void GlbWriter::extend(gltf::Material& material, const char* name, gltf::Value::Object members) {
    use(name);
    material.extensions[name] = gltf::Value(std::move(members));
}

namespace {

gltf::Value number(double value) {
    return gltf::Value(value);
}
gltf::Value color_value(const glm::dvec3& color) {
    return gltf::Value(gltf::Value::Array{number(color.x), number(color.y), number(color.z)});
}

}  // namespace

void GlbWriter::add_volume(const Material& source, gltf::Material& material) {
    const double thickness = constant(source.glass.thickness, "thickness");
    const double distance = constant(source.glass.attenuation_distance, "attenuation distance");
    const glm::dvec3 color = constant(source.glass.attenuation_color, "attenuation colour");
    if (thickness == 0.0 && distance == 0.0 && color == glm::dvec3(1.0)) return;
    gltf::Value::Object members{{"thicknessFactor", number(thickness)}, {"attenuationColor", color_value(color)}};
    if (distance != 0.0) members["attenuationDistance"] = number(distance);
    add_texture(members, "thicknessTexture", source.textures[TextureSlot::thickness]);
    extend(material, "KHR_materials_volume", std::move(members));
}

void GlbWriter::add_clearcoat(const Material& source, gltf::Material& material) {
    const double strength = constant(source.layers.clearcoat, "clear coat");
    if (strength == 0.0) return;
    gltf::Value::Object members{
        {"clearcoatFactor", number(strength)},
        {"clearcoatRoughnessFactor", number(constant(source.layers.clearcoat_roughness, "clear coat roughness"))}};
    add_texture(members, "clearcoatTexture", source.textures[TextureSlot::clearcoat]);
    add_texture(members, "clearcoatRoughnessTexture", source.textures[TextureSlot::clearcoat_roughness]);
    add_texture(members, "clearcoatNormalTexture", source.textures[TextureSlot::clearcoat_normal],
                source.textures.clearcoat_normal_scale);
    extend(material, "KHR_materials_clearcoat", std::move(members));
}

void GlbWriter::add_sheen(const Material& source, gltf::Material& material) {
    const glm::dvec3 color = constant(source.layers.sheen_color, "sheen colour");
    if (color == glm::dvec3(0.0)) return;
    gltf::Value::Object members{
        {"sheenColorFactor", color_value(color)},
        {"sheenRoughnessFactor", number(constant(source.layers.sheen_roughness, "sheen roughness"))}};
    add_texture(members, "sheenColorTexture", source.textures[TextureSlot::sheen_color]);
    add_texture(members, "sheenRoughnessTexture", source.textures[TextureSlot::sheen_roughness]);
    extend(material, "KHR_materials_sheen", std::move(members));
}

void GlbWriter::add_anisotropy(const Material& source, gltf::Material& material) {
    const double strength = constant(source.layers.anisotropy, "anisotropy");
    if (strength == 0.0) return;
    gltf::Value::Object members{
        {"anisotropyStrength", number(strength)},
        {"anisotropyRotation", number(constant(source.layers.anisotropy_rotation, "rotation of anisotropy"))}};
    add_texture(members, "anisotropyTexture", source.textures[TextureSlot::anisotropy]);
    extend(material, "KHR_materials_anisotropy", std::move(members));
}

void GlbWriter::add_material(const Material& source) {
    gltf::Material material;
    material.name = source.name;
    gltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = numbers(constant(source.base_color, "base colour"));
    pbr.baseColorFactor.push_back(constant(source.opacity.alpha, "alpha"));
    pbr.metallicFactor = constant(source.gloss.metallic, "metallic");
    pbr.roughnessFactor = constant(source.gloss.roughness, "roughness");
    material.emissiveFactor = numbers(constant(source.glow.color, "emission"));
    material.doubleSided = source.double_sided;
    const auto set = [&](const TextureRef& from, auto& to) {
        if (from.image == no_index) return;
        to.index = texture_of(from);
        to.texCoord = from.uv_set;
    };
    set(source.textures[TextureSlot::base_color], pbr.baseColorTexture);
    set(source.textures[TextureSlot::metallic_roughness], pbr.metallicRoughnessTexture);
    set(source.textures[TextureSlot::emission], material.emissiveTexture);
    set(source.textures[TextureSlot::normal], material.normalTexture);
    material.normalTexture.scale = source.textures.normal_scale;

    // The factor of glTF is at most 1; the strength holds the rest.
    const double largest =
        std::max({material.emissiveFactor[0], material.emissiveFactor[1], material.emissiveFactor[2]});
    const double excess = std::max(largest, 1.0);
    for (double& factor : material.emissiveFactor) factor /= excess;
    if (const double strength = constant(source.glow.strength, "strength") * excess; strength != 1.0) {
        extend(material, "KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
    }
    if (const double ior = constant(source.gloss.ior, "ior"); ior != 1.5)
        extend(material, "KHR_materials_ior", {{"ior", number(ior)}});
    const glm::dvec3 color = constant(source.gloss.specular_color, "specular colour");
    if (constant(source.gloss.specular, "specular") != 1.0 || color != glm::dvec3(1.0)) {
        gltf::Value::Object members{{"specularFactor", number(key_value(source.gloss.specular, 0))}};
        members["specularColorFactor"] = color_value(color);
        add_texture(members, "specularTexture", source.textures[TextureSlot::specular]);
        add_texture(members, "specularColorTexture", source.textures[TextureSlot::specular_color]);
        extend(material, "KHR_materials_specular", std::move(members));
    }
    if (const double share = constant(source.glass.transmission, "transmission"); share != 0.0) {
        gltf::Value::Object members{{"transmissionFactor", number(share)}};
        add_texture(members, "transmissionTexture", source.textures[TextureSlot::transmission]);
        extend(material, "KHR_materials_transmission", std::move(members));
    }
    add_volume(source, material);
    add_clearcoat(source, material);
    add_sheen(source, material);
    add_anisotropy(source, material);
    model_.materials.push_back(std::move(material));
}

}  // namespace aleph
