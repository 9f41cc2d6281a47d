#include "engine/gltf/textures.h"

#include <fmt/format.h>

#include "engine/base/errors.h"
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

std::size_t count_images(const GltfReader& reader) {
    return reader.source.document.contains("images") ? reader.source.document["images"].size() : 0;
}

}  // namespace

GltfTextures::GltfTextures(GltfReader& reader) : reader_(reader), image_of_(count_images(reader), no_index) {}

TextureRef GltfTextures::read(int index, int uv_set) {
    TextureRef reference;
    if (index < 0) return reference;
    const tinygltf::Model& model = reader_.source.model;
    const tinygltf::Texture& texture = model.textures[index];
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
        const tinygltf::Sampler& sampler = model.samplers[texture.sampler];
        reference.wrap_u = wrap_of(sampler.wrapS);
        reference.wrap_v = wrap_of(sampler.wrapT);
        reference.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return reference;
}

TextureRef GltfTextures::read(const nlohmann::json& owner, const char* key) {
    const auto info = owner.find(key);
    if (info == owner.end()) return {};
    TextureRef reference = read((*info)["index"].get<int>(), info->value("texCoord", 0));
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

}  // namespace aleph
