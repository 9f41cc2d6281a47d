// Images, textures and materials of a .glb.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "tests/unit/engine/gltf/glb_parts.h"

namespace aleph {

void GlbWriter::add_images() {
    for (const SceneImage& source : scene_.images) {
        if (source.path.empty()) refuse("embedded images");
        const auto path = std::filesystem::path(scene_.file).parent_path() / source.path;
        std::ifstream stream(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
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

gltf::Value GlbWriter::texture_info(const TextureRef& reference) {
    const int texture = texture_of(reference);
    return gltf::Value(
        gltf::Value::Object{{"index", gltf::Value(texture)}, {"texCoord", gltf::Value(reference.uv_set)}});
}

void GlbWriter::add_material(const Material& source) {
    gltf::Material material;
    material.name = source.name;
    gltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = numbers(constant(source.base_color, "base colour"));
    pbr.baseColorFactor.push_back(constant(source.alpha, "alpha"));
    pbr.metallicFactor = constant(source.metallic, "metallic");
    pbr.roughnessFactor = constant(source.roughness, "roughness");
    material.emissiveFactor = numbers(constant(source.emission, "emission"));
    material.doubleSided = source.double_sided;
    const auto set = [&](const TextureRef& from, auto& to) {
        if (from.image == no_index) return;
        to.index = texture_of(from);
        to.texCoord = from.uv_set;
    };
    set(source.base_color_texture, pbr.baseColorTexture);
    set(source.metallic_roughness_texture, pbr.metallicRoughnessTexture);
    set(source.emission_texture, material.emissiveTexture);

    // The factor of glTF is at most 1; the strength holds the rest.
    const double largest =
        std::max({material.emissiveFactor[0], material.emissiveFactor[1], material.emissiveFactor[2]});
    const double excess = std::max(largest, 1.0);
    for (double& factor : material.emissiveFactor) factor /= excess;
    const auto number = [](double value) { return gltf::Value(value); };
    const auto extend = [&](const char* name, gltf::Value::Object members) {
        use(name);
        material.extensions[name] = gltf::Value(std::move(members));
    };
    if (const double strength = constant(source.emission_strength, "strength") * excess; strength != 1.0) {
        extend("KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
    }
    if (const double ior = constant(source.ior, "ior"); ior != 1.5) extend("KHR_materials_ior", {{"ior", number(ior)}});
    const glm::dvec3 color = constant(source.specular_color, "specular colour");
    if (constant(source.specular, "specular") != 1.0 || color != glm::dvec3(1.0)) {
        gltf::Value::Object members{{"specularFactor", number(key_value(source.specular, 0))}};
        members["specularColorFactor"] =
            gltf::Value(gltf::Value::Array{number(color.x), number(color.y), number(color.z)});
        if (source.specular_texture.image != no_index)
            members["specularTexture"] = texture_info(source.specular_texture);
        extend("KHR_materials_specular", std::move(members));
    }
    if (const double share = constant(source.transmission, "transmission"); share != 0.0) {
        extend("KHR_materials_transmission", {{"transmissionFactor", number(share)}});
    }
    model_.materials.push_back(std::move(material));
}

}  // namespace aleph
