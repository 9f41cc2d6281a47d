// glTF writer: cameras and lights.
#include <algorithm>
#include <cmath>

#include "engine/gltf/write/writer.h"

namespace aleph {

namespace {

/// glTF wants a width and a far plane of an orthographic view; the reader and most programs use the height alone.
constexpr double picture_aspect = 4.0 / 3.0;
constexpr double far_plane = 1e4;  // m

/// A range of 0 is unlimited; between keys only a number can stand for it.
constexpr double unlimited_range = 1e9;  // m

OrderedJson write_camera(GltfWriter& writer, const Camera& camera, const std::string& place) {
    OrderedJson written;
    if (!camera.name.empty()) written["name"] = camera.name;
    const Track<double>& track = camera.orthographic ? camera.half_height : camera.fov;
    const double first = first_value(track);
    if (camera.orthographic) {
        written["type"] = "orthographic";
        written["orthographic"] = {{"xmag", first * picture_aspect},
                                   {"ymag", first},
                                   {"znear", camera.near_plane},
                                   {"zfar", std::max(far_plane, 2.0 * camera.near_plane)}};
    } else {
        written["type"] = "perspective";
        written["perspective"] = {{"yfov", first}, {"znear", camera.near_plane}};
    }
    if (!is_animated(track)) return written;
    WrittenKeys keys = writer.keys_of(track, place);
    writer.animate(place + (camera.orthographic ? "/orthographic/ymag" : "/perspective/yfov"), keys);
    if (camera.orthographic) {
        for (float& value : keys.values) value *= static_cast<float>(picture_aspect);
        writer.animate(place + "/orthographic/xmag", keys);
    }
    return written;
}

void add_number(GltfWriter& writer, OrderedJson& owner, const char* key, const Track<double>& track,
                const std::string& place) {
    owner[key] = first_value(track);
    if (is_animated(track)) writer.animate(place + "/" + key, writer.keys_of(track, place));
}

OrderedJson write_light(GltfWriter& writer, const Light& light, const std::string& place) {
    OrderedJson written;
    if (!light.name.empty()) written["name"] = light.name;
    written["type"] = light.kind == Light::Kind::point  ? "point"
                      : light.kind == Light::Kind::spot ? "spot"
                                                        : "directional";
    // Colours of glTF are at most 1; the intensity holds the rest.
    Track<glm::dvec3> color = light.color;
    Track<double> intensity = light.intensity;
    const double excess = scale_to_one(color);
    for (double& value : intensity.values) value *= excess;
    written["color"] = to_json(first_value(color));
    if (is_animated(color)) writer.animate(place + "/color", writer.keys_of(color, place));
    add_number(writer, written, "intensity", intensity, place);
    if (light.kind != Light::Kind::directional && (is_animated(light.range) || key_value(light.range, 0) > 0.0)) {
        Track<double> range = light.range;
        for (std::size_t i = 0; i < range.key_count(); ++i) {
            double& value = range.values[range.interpolation == Interpolation::cubic ? 3 * i + 1 : i];
            if (!(value > 0.0)) value = unlimited_range;
        }
        add_number(writer, written, "range", range, place);
    }
    if (light.kind != Light::Kind::spot) return written;
    OrderedJson& spot = written["spot"];
    add_number(writer, spot, "outerConeAngle", light.outer_cone, place + "/spot");
    add_number(writer, spot, "innerConeAngle", light.inner_cone, place + "/spot");
    // The inner cone has to be the narrower one.
    const double outer = spot["outerConeAngle"].get<double>();
    if (spot["innerConeAngle"].get<double>() >= outer) spot["innerConeAngle"] = std::nextafter(outer, 0.0);
    return written;
}

}  // namespace

double scale_to_one(Track<glm::dvec3>& color) {
    double largest = 1.0;
    for (std::size_t i = 0; i < color.key_count(); ++i) {
        const glm::dvec3& value = key_value(color, i);
        largest = std::max({largest, value.x, value.y, value.z});
    }
    if (largest == 1.0) return 1.0;
    for (glm::dvec3& value : color.values) value /= largest;
    return largest;
}

void write_cameras_and_lights(GltfWriter& writer) {
    const Scene& scene = writer.scene;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        writer.add("cameras", write_camera(writer, scene.cameras[i], "/cameras/" + std::to_string(i)));
    if (scene.lights.empty()) return;
    OrderedJson lights = OrderedJson::array();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const std::string place = "/extensions/KHR_lights_punctual/lights/" + std::to_string(i);
        lights.push_back(write_light(writer, scene.lights[i], place));
    }
    writer.extend(writer.document, "KHR_lights_punctual")["lights"] = std::move(lights);
}

}  // namespace aleph
