#include "scenes/common/generator.h"

#include "engine/base/color.h"
#include "engine/image/image_file.h"
#include "engine/load/load_scene.h"

namespace aleph {

std::vector<DrawnTexture> join(const std::vector<std::vector<DrawnTexture>>& lists) {
    std::vector<DrawnTexture> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

void write_textures(const std::filesystem::path& folder, const std::vector<DrawnTexture>& textures) {
    for (const DrawnTexture& texture : textures) {
        Image<Rgb> linear(texture.srgb.width, texture.srgb.height);
        for (std::size_t i = 0; i < linear.size(); ++i)
            for (int channel = 0; channel < 3; ++channel)
                linear.pixels[i][channel] =
                    srgb_to_linear(static_cast<float>(texture.srgb.pixels[i][channel]) / 255.0f);
        write_png(folder / (texture.name + ".png"), linear);
    }
}

Scene begin_scene(const std::string& name, int last_frame, double exposure, const std::string& folder,
                  const std::vector<DrawnTexture>& textures) {
    Scene scene;
    scene.source.name = name;
    scene.film.range = FrameRange{0, last_frame};
    scene.film.camera = "camera";
    scene.film.exposure = exposure;
    for (const DrawnTexture& texture : textures) {
        SceneImage image{.name = texture.name,
                         .path = folder + texture.name + ".png",
                         .bytes = Image<glm::u8vec4>(texture.srgb.width, texture.srgb.height)};
        for (std::size_t i = 0; i < texture.srgb.size(); ++i)
            image.bytes.pixels[i] = glm::u8vec4(texture.srgb.pixels[i], 255);
        scene.images.push_back(image);
    }
    return scene;
}

void write_scene(const std::filesystem::path& folder, const Scene& scene, const std::vector<DrawnTexture>& textures) {
    std::filesystem::create_directories(folder);
    if (!textures.empty()) {
        std::filesystem::create_directories(folder / "textures");
        write_textures(folder / "textures", textures);
    }
    save_scene(scene, folder / "scene.json");
}

}  // namespace aleph
