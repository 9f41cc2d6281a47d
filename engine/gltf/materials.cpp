#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"
#include "engine/image/image_file.h"

namespace aleph {

namespace {

/// Bytes of decoded pixels in one file.
constexpr std::uint64_t max_pixel_bytes = std::uint64_t{2} << 30;

SceneImage read_image(const GltfReader& reader, std::size_t index) {
    const std::string place = fmt::format("/images/{}", index);
    EncodedImage encoded = load_encoded_image(reader.source, index);
    SceneImage image;
    image.name = reader.source.document["images"][index].value("name", fmt::format("image{}", index));
    image.path = std::move(encoded.path);
    try {
        const DecodedTexture decoded = decode_texture(encoded.bytes, place);
        image.bytes = Image<glm::u8vec4>(decoded.bytes.width, decoded.bytes.height);
        for (std::size_t i = 0; i < decoded.bytes.size(); ++i) {
            const auto& pixel = decoded.bytes.pixels[i];
            image.bytes.pixels[i] = glm::u8vec4(pixel[0], pixel[1], pixel[2], pixel[3]);
        }
    } catch (const InputError& error) {
        if (error.file() == reader.source.file) throw;
        throw InputError(reader.source.file, place, error.reason());
    }
    return image;
}

Wrap wrap_of(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        default:
            return Wrap::repeat;
    }
}

/// Reads materials, and the images that their textures use.
class MaterialReader {
  public:
    explicit MaterialReader(GltfReader& reader)
        : reader_(reader), model_(reader.source.model), image_of_(count_images(reader), no_index) {}

    Material read(std::size_t index);

  private:
    static std::size_t count_images(const GltfReader& reader) {
        return reader.source.document.contains("images") ? reader.source.document["images"].size() : 0;
    }
    TextureRef texture(int index, int uv_set);
    TextureRef texture(const nlohmann::json& owner, const char* key);
    double clamped(double value, double low, double high, const char* name);
    glm::dvec3 clamped(const glm::dvec3& value, double high, const char* name);
    void read_extensions(const nlohmann::json& extensions, Material& material);

    GltfReader& reader_;
    const tinygltf::Model& model_;
    std::vector<int> image_of_;  ///< glTF image -> scene image, no_index until needed
    std::uint64_t pixel_bytes_ = 0;
    std::string place_;  ///< of the material that is read
};

TextureRef MaterialReader::texture(int index, int uv_set) {
    TextureRef reference;
    if (index < 0) return reference;
    const tinygltf::Texture& texture = model_.textures[index];
    const auto source = static_cast<std::size_t>(texture.source);
    if (image_of_[source] == no_index) {
        SceneImage image = read_image(reader_, source);
        pixel_bytes_ += image.bytes.size() * sizeof(glm::u8vec4);
        if (pixel_bytes_ > max_pixel_bytes) {
            throw InputError(reader_.source.file, fmt::format("/images/{}", source),
                             fmt::format("the file's images decode to more than {} bytes", max_pixel_bytes));
        }
        image_of_[source] = static_cast<int>(reader_.part.images.size());
        reader_.part.images.push_back(std::move(image));
    }
    reference.image = image_of_[source];
    reference.uv_set = uv_set;
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = model_.samplers[texture.sampler];
        reference.wrap_u = wrap_of(sampler.wrapS);
        reference.wrap_v = wrap_of(sampler.wrapT);
        reference.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return reference;
}

TextureRef MaterialReader::texture(const nlohmann::json& owner, const char* key) {
    const auto info = owner.find(key);
    if (info == owner.end()) return {};
    TextureRef reference = texture((*info)["index"].get<int>(), info->value("texCoord", 0));
    const auto extensions = info->find("extensions");
    if (extensions == info->end()) return reference;
    const auto transform = extensions->find("KHR_texture_transform");
    if (transform == extensions->end()) return reference;
    const auto pair = [&](const char* name, const glm::dvec2& absent) {
        const auto found = transform->find(name);
        if (found == transform->end()) return absent;
        return glm::dvec2((*found)[0].get<double>(), (*found)[1].get<double>());
    };
    reference.uv_offset = pair("offset", glm::dvec2(0.0));
    reference.uv_scale = pair("scale", glm::dvec2(1.0));
    reference.uv_rotation = transform->value("rotation", 0.0);
    reference.uv_set = transform->value("texCoord", reference.uv_set);
    return reference;
}

double MaterialReader::clamped(double value, double low, double high, const char* name) {
    const double inside = std::clamp(value, low, high);
    if (inside != value) reader_.warn(place_, fmt::format("{} {} is clamped to {}", name, value, inside));
    return inside;
}

glm::dvec3 MaterialReader::clamped(const glm::dvec3& value, double high, const char* name) {
    return {clamped(value.x, 0.0, high, name), clamped(value.y, 0.0, high, name), clamped(value.z, 0.0, high, name)};
}

void MaterialReader::read_extensions(const nlohmann::json& extensions, Material& material) {
    constexpr double unlimited = std::numeric_limits<double>::max();
    if (const auto found = extensions.find("KHR_materials_emissive_strength"); found != extensions.end()) {
        material.emission_strength = clamped(found->value("emissiveStrength", 1.0), 0.0, unlimited, "emissiveStrength");
    }
    if (const auto found = extensions.find("KHR_materials_ior"); found != extensions.end()) {
        const double ior = found->value("ior", 1.5);
        material.ior = ior == 0.0 ? 0.0 : clamped(ior, 1.0, unlimited, "ior");  // 0 is allowed: full reflection
    }
    material.unlit = extensions.contains("KHR_materials_unlit");
    if (const auto found = extensions.find("KHR_materials_transmission"); found != extensions.end()) {
        material.transmission = clamped(found->value("transmissionFactor", 0.0), 0.0, 1.0, "transmissionFactor");
        material.transmission_texture = texture(*found, "transmissionTexture");
    }
    if (const auto found = extensions.find("KHR_materials_specular"); found != extensions.end()) {
        material.specular = clamped(found->value("specularFactor", 1.0), 0.0, 1.0, "specularFactor");
        const auto color = found->value("specularColorFactor", std::vector<double>{1.0, 1.0, 1.0});
        material.specular_color = clamped({color[0], color[1], color[2]}, unlimited, "specularColorFactor");
        material.specular_texture = texture(*found, "specularTexture");
        material.specular_color_texture = texture(*found, "specularColorTexture");
    }
}

Material MaterialReader::read(std::size_t index) {
    const tinygltf::Material& source = model_.materials[index];
    place_ = fmt::format("/materials/{}", index);
    Material material;
    material.name = source.name.empty() ? fmt::format("material{}", index) : source.name;
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const std::vector<double>& base = pbr.baseColorFactor;
    material.base_color = clamped({base[0], base[1], base[2]}, 1.0, "baseColorFactor");
    material.alpha = clamped(base[3], 0.0, 1.0, "baseColorFactor");
    material.metallic = clamped(pbr.metallicFactor, 0.0, 1.0, "metallicFactor");
    material.roughness = clamped(pbr.roughnessFactor, 0.0, 1.0, "roughnessFactor");
    const nlohmann::json& raw = reader_.source.document["materials"][index];
    if (const auto found = raw.find("pbrMetallicRoughness"); found != raw.end()) {
        material.base_color_texture = texture(*found, "baseColorTexture");
        material.metallic_roughness_texture = texture(*found, "metallicRoughnessTexture");
    }
    const std::vector<double>& emission = source.emissiveFactor;
    material.emission = clamped({emission[0], emission[1], emission[2]}, 1.0, "emissiveFactor");
    material.emission_texture = texture(raw, "emissiveTexture");
    material.double_sided = source.doubleSided;
    if (source.alphaMode == "MASK") material.alpha_mode = Material::AlphaMode::mask;
    if (source.alphaMode == "BLEND") material.alpha_mode = Material::AlphaMode::blend;
    material.alpha_cutoff = raw.value("alphaCutoff", 0.5);
    if (const auto extensions = raw.find("extensions"); extensions != raw.end()) read_extensions(*extensions, material);
    return material;
}

}  // namespace

void read_materials(GltfReader& reader) {
    MaterialReader materials(reader);
    std::size_t with_normal = 0, with_occlusion = 0;
    for (std::size_t i = 0; i < reader.source.model.materials.size(); ++i) {
        reader.part.materials.push_back(materials.read(i));
        if (reader.source.model.materials[i].normalTexture.index >= 0) ++with_normal;
        if (reader.source.model.materials[i].occlusionTexture.index >= 0) ++with_occlusion;
    }
    if (with_normal + with_occlusion > 0) {
        reader.warn("materials", fmt::format("normal textures ({}) and occlusion textures ({}) are not used",
                                             with_normal, with_occlusion));
    }
}

}  // namespace aleph
