// glTF reader: materials with their extensions; their textures and images.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/gltf/reader.h"
#include "engine/gltf/validate/material_table.h"
#include "engine/image/image_file.h"

namespace aleph {

namespace {

/// Bytes of decoded pixels in one file.
constexpr std::uint64_t max_pixel_bytes = std::uint64_t{2} << 30;
/// Images that are read one by one, decoded in parallel and then counted.
constexpr std::size_t images_at_once = 16;

void decode_image(const GltfReader& reader, std::size_t index, const Bytes& encoded, SceneImage& image) {
    const std::string place = fmt::format("/images/{}", index);
    try {
        image.bytes = decode_texture(encoded, place).bytes;
    } catch (const InputError& error) {
        throw InputError(reader.source.file, place, error.reason());
    }
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

/// The object that has an owner's properties; null where a material lacks it.
const nlohmann::json* find_owner(const nlohmann::json& material, const char* name) {
    if (is_gltf_extension(name)) return find_extension(material, name);
    if (*name == '\0') return &material;
    const auto found = material.find(name);
    return found == material.end() ? nullptr : &*found;
}

/// Reads materials. Factors out of range are clamped, with a warning. Images that textures use are read at the end,
/// each once.
class MaterialReader {
  public:
    explicit MaterialReader(GltfReader& reader) : reader_(reader), image_of_(reader.source.count("images"), no_index) {}

    Material read(std::size_t index);
    void read_images();

  private:
    double clamped(double value, const GltfFactor& factor);
    void read_owner(const char* name, const nlohmann::json& owner, Material& material);
    TextureRef read_texture(const nlohmann::json& info);
    int use_image(std::size_t index);

    GltfReader& reader_;
    std::string place_;              ///< of the material that is read
    std::vector<int> image_of_;      ///< glTF image -> scene image, no_index until needed
    std::vector<std::size_t> used_;  ///< glTF images, in the order of the part's
};

int MaterialReader::use_image(std::size_t index) {
    if (image_of_[index] == no_index) {
        image_of_[index] = append(used_, index);
    }
    return image_of_[index];
}

void MaterialReader::read_images() {
    std::vector<SceneImage>& images = reader_.part.images;
    const GltfSource& source = reader_.source;
    std::uint64_t bytes = 0;
    std::vector<Bytes> encoded;
    for (std::size_t begin = 0; begin < used_.size(); begin += images_at_once) {
        encoded.clear();
        for (std::size_t i = begin; i < std::min(begin + images_at_once, used_.size()); ++i) {
            SceneImage& image = images.emplace_back();
            image.name = source.document["images"][used_[i]].value("name", fmt::format("image{}", used_[i]));
            encoded.push_back(load_encoded_image(source, used_[i], image.path));
        }
        parallel_in_order(encoded.size(), [&](std::size_t i) {
            decode_image(reader_, used_[begin + i], encoded[i], images[begin + i]);
        });
        for (std::size_t i = begin; i < images.size(); ++i) {
            bytes += images[i].bytes.size() * sizeof(glm::u8vec4);
            if (bytes > max_pixel_bytes) {
                throw InputError(source.file, fmt::format("/images/{}", used_[i]),
                                 fmt::format("the file's images decode to more than {} bytes", max_pixel_bytes));
            }
        }
    }
}

TextureRef MaterialReader::read_texture(const nlohmann::json& info) {
    const tinygltf::Model& model = reader_.source.model;
    const tinygltf::Texture& texture = model.textures[info["index"].get<std::size_t>()];
    TextureRef reference;
    reference.image = use_image(static_cast<std::size_t>(texture.source));
    reference.uv_set = info.value("texCoord", 0);
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = model.samplers[texture.sampler];
        reference.wrap_u = wrap_of(sampler.wrapS);
        reference.wrap_v = wrap_of(sampler.wrapT);
        reference.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    const nlohmann::json* transform = find_extension(info, "KHR_texture_transform");
    if (transform == nullptr) return reference;
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
        const auto info = owner.find(texture.key);
        if (info == owner.end()) return;
        material.textures[texture.slot] = read_texture(*info);
        if (texture.scale != nullptr) material.textures.*texture.scale = info->value("scale", 1.0);
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
    materials.read_images();
    if (with_occlusion > 0) {
        reader.warn("materials", fmt::format("occlusion textures ({}) are not used", with_occlusion));
    }
}

int default_material(GltfReader& reader) {
    if (reader.default_material == no_index) {
        reader.default_material = append(reader.part.materials, make_gltf_material());
        reader.part.materials.back().name = "default";
    }
    return reader.default_material;
}

}  // namespace aleph
