#include "engine/gltf/write/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/atomic_file.h"
#include "engine/base/index.h"
#include "engine/gltf/write/writer.h"

namespace aleph {

namespace {

const char* accessor_type(const WrittenKeys& keys) {
    return keys.row == 1 ? "SCALAR" : keys.row == 3 ? "VEC3" : "VEC4";
}

/// In the order of Interpolation.
constexpr std::array interpolation_names{"STEP", "LINEAR", "STEP", "CUBICSPLINE"};

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

/// Adds a warning for each kind of thing that the scene says and glTF cannot hold.
void warn_of_losses(GltfWriter& writer) {
    const Scene& scene = writer.scene;
    const auto warn = [&](bool is_lost, const char* what) {
        if (is_lost) writer.warnings.push_back(fmt::format("not written, because glTF cannot hold it: {}", what));
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

}  // namespace

void GltfWriter::add_frames(SampledTimes& times, const std::string& place) {
    const FrameRate& rate = scene.film.frame_rate;
    const FrameRange frames = times.find_frames(rate, range);
    if (frames.last < frames.first) return;
    const auto count = static_cast<std::uint64_t>(frames.last - frames.first) + 1;
    // Twice as many keys as the scene itself has are no matter.
    constexpr std::uint64_t bytes_per_key = 12 * sizeof(float);
    if (count > 2 * times.count()) buffer.charge(std::min(count, max_made_bytes) * bytes_per_key, place);
    for (std::int64_t frame = frames.first; frame <= frames.last; ++frame)
        times.smooth.push_back(rate.seconds_of(frame));
}

template <class T>
WrittenKeys GltfWriter::keys_of(const Track<T>& track, const std::string& place) {
    if (has_exact_keys(track)) return make_keys(track);
    SampledTimes sampled;
    sampled.add(track);
    add_frames(sampled, place);
    return make_sampled_keys(sampled.make_key_times(), [&](double t) { return evaluate(track, t); });
}
template WrittenKeys GltfWriter::keys_of(const Track<double>&, const std::string&);
template WrittenKeys GltfWriter::keys_of(const Track<glm::dvec3>&, const std::string&);
template WrittenKeys GltfWriter::keys_of(const Track<glm::dquat>&, const std::string&);

int GltfWriter::add_sampler(const WrittenKeys& keys, int output) {
    samplers.push_back({{"input", buffer.add_times(keys.times)},
                        {"interpolation", interpolation_names[index_of(keys.interpolation)]},
                        {"output", output}});
    return static_cast<int>(samplers.size()) - 1;
}

void GltfWriter::add_channel(const std::string& pointer, int sampler) {
    extensions.insert("KHR_animation_pointer");
    const OrderedJson target = {{"path", "pointer"},
                                {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    channels.push_back({{"sampler", sampler}, {"target", target}});
}

void GltfWriter::animate(int node, const char* path, const WrittenKeys& keys) {
    if (keys.times.empty() || keys.is_constant()) return;
    const bool is_weights = std::string_view(path) == "weights";
    const int output = buffer.add_floats(keys.values, is_weights ? "SCALAR" : accessor_type(keys));
    const int sampler = add_sampler(keys, output);
    channels.push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

void GltfWriter::animate(const std::string& pointer, const WrittenKeys& keys) {
    if (keys.times.empty() || keys.is_constant()) return;
    add_channel(pointer, add_sampler(keys, buffer.add_floats(keys.values, accessor_type(keys))));
}

void GltfWriter::animate_visibility(int node, const WrittenKeys& keys) {
    if (keys.times.empty() || keys.is_constant()) return;
    const std::vector<std::uint8_t> values(keys.values.begin(), keys.values.end());
    add_channel("/nodes/" + std::to_string(node) + "/extensions/KHR_node_visibility/visible",
                add_sampler(keys, buffer.add_bytes(values)));
}

std::vector<std::string> write_gltf(const Scene& scene, const std::filesystem::path& path) {
    GltfWriter writer(scene, path.string());
    writer.document["asset"] = {{"version", "2.0"}, {"generator", "aleph"}};
    write_materials(writer);
    write_cameras_and_lights(writer);
    write_nodes(writer);
    write_skins(writer);
    if (!writer.channels.empty()) {
        OrderedJson animation;
        if (!scene.source.name.empty()) animation["name"] = scene.source.name;
        animation["samplers"] = std::move(writer.samplers);
        animation["channels"] = std::move(writer.channels);
        writer.add("animations", std::move(animation));
    }
    if (!writer.extensions.empty()) writer.document["extensionsUsed"] = writer.extensions;
    warn_of_losses(writer);
    write_file(path, writer.buffer.take_file(std::move(writer.document)));
    return writer.warnings;
}

}  // namespace aleph
