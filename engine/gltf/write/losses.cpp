// glTF writer: warnings of what the scene says and glTF cannot hold.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/gltf/write/writer.h"

namespace aleph {

namespace {

bool has_lens(const Camera& camera) {
    const auto is_set = [](const Track<double>& track) { return is_animated(track) || key_value(track, 0) != 0.0; };
    return camera.shutter.x != camera.shutter.y || is_set(camera.aperture) || is_set(camera.shift_x) ||
           is_set(camera.shift_y);
}

/// True where the camera that looks first is not the first of the file.
bool chooses_camera(const Scene& scene) {
    const bool has_camera = std::ranges::any_of(scene.nodes, [](const Node& n) { return n.camera != no_index; });
    return has_camera && CameraNames(scene).find("") != 0;
}

bool is_black(const Track<glm::dvec3>& radiance) {
    return std::ranges::all_of(radiance.values, [](const glm::dvec3& value) { return value == glm::dvec3(0.0); });
}

}  // namespace

void warn_of_losses(GltfWriter& writer) {
    const Scene& scene = writer.scene;
    const auto warn = [&](bool is_lost, const char* what) {
        if (is_lost)
            writer.warnings.push_back(fmt::format("not written, because glTF cannot hold it: {}", what));
    };
    warn(scene.environment.radiance && !is_black(*scene.environment.radiance), "the environment's light");
    warn(scene.film.exposure.has_value(), "the exposure");
    warn(!scene.film.cuts.empty(), "cuts");
    warn(!scene.film.camera_keys.empty(), "the change of cameras over time");
    warn(scene.film.camera_keys.empty() && chooses_camera(scene), "the choice of the camera");
    warn(std::ranges::any_of(scene.cameras, has_lens), "the lens (aperture, focus, shift) and shutter of cameras");
    warn(scene.film.viewing != ViewingConditions{}, "the display and the viewer's distance");
    warn(!scene.source.settings.empty(), "render settings");
}

}  // namespace aleph
