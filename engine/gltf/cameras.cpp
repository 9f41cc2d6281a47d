// glTF reader: cameras and lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/gltf/reader.h"

namespace aleph {

namespace {

Camera read_camera(const tinygltf::Camera& source, std::size_t index) {
    Camera camera;
    camera.name = source.name.empty() ? fmt::format("camera{}", index) : source.name;
    camera.orthographic = source.type == "orthographic";
    // znear and zfar are for depth buffers. Nothing is clipped here, so near_plane keeps its default.
    if (camera.orthographic) {
        camera.half_height = std::abs(source.orthographic.ymag);
    } else {
        camera.fov = source.perspective.yfov;
    }
    return camera;
}

Light::Kind kind_of(const std::string& type) {
    if (type == "point") return Light::Kind::point;
    return type == "spot" ? Light::Kind::spot : Light::Kind::directional;
}

Light read_light(GltfReader& reader, const tinygltf::Light& source, std::size_t index) {
    const std::string place = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    const auto not_negative = [&](double value, const char* name) {
        if (value < 0.0) reader.warn(place, fmt::format("{} {} is clamped to 0", name, value));
        return std::max(value, 0.0);
    };
    Light light;
    light.name = source.name.empty() ? fmt::format("light{}", index) : source.name;
    light.kind = kind_of(source.type);
    if (!source.color.empty()) {
        light.color = glm::dvec3(not_negative(source.color[0], "color"), not_negative(source.color[1], "color"),
                                 not_negative(source.color[2], "color"));
    }
    light.intensity = not_negative(source.intensity, "intensity");
    light.range = light.kind == Light::Kind::directional ? 0.0 : source.range;
    if (light.kind == Light::Kind::spot) {
        const nlohmann::json& spot =
            reader.source.document["extensions"]["KHR_lights_punctual"]["lights"][index]["spot"];
        constexpr double quarter_turn = std::numbers::pi / 2.0;  // a float may exceed it by rounding
        light.inner_cone = std::min(spot.value("innerConeAngle", 0.0), quarter_turn);
        light.outer_cone = std::min(spot.value("outerConeAngle", std::numbers::pi / 4.0), quarter_turn);
    }
    return light;
}

}  // namespace

void read_cameras_and_lights(GltfReader& reader) {
    const tinygltf::Model& model = reader.source.model;
    for (std::size_t i = 0; i < model.cameras.size(); ++i)
        reader.part.cameras.push_back(read_camera(model.cameras[i], i));
    for (std::size_t i = 0; i < model.lights.size(); ++i) {
        reader.part.lights.push_back(read_light(reader, model.lights[i], i));
    }
}

}  // namespace aleph
