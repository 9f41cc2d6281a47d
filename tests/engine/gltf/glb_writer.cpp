// Buffers, meshes, cameras, lights, nodes and animations of a .glb, and the file.

#include "tests/engine/gltf/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "tests/engine/gltf/glb_parts.h"

namespace aleph {

int GlbWriter::add_view(const void* data, std::size_t size, int target) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    gltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.target = target;
    const auto* bytes = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), bytes, bytes + size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

int GlbWriter::add_floats(const std::vector<float>& values, int type, std::size_t components, bool with_bounds) {
    gltf::Accessor accessor;
    accessor.bufferView = add_view(values.data(), values.size() * sizeof(float));
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.count = values.size() / components;
    accessor.type = type;
    for (std::size_t k = 0; with_bounds && k < components; ++k) {
        double low = values[k], high = values[k];
        for (std::size_t i = k; i < values.size(); i += components) {
            low = std::min(low, static_cast<double>(values[i]));
            high = std::max(high, static_cast<double>(values[i]));
        }
        accessor.minValues.push_back(low);
        accessor.maxValues.push_back(high);
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
}

template <class V>
int GlbWriter::add_vectors(const std::vector<V>& vectors, int type, bool with_bounds) {
    std::vector<float> values;
    for (const V& v : vectors) {
        for (int k = 0; k < V::length(); ++k) values.push_back(v[k]);
    }
    return add_floats(values, type, static_cast<std::size_t>(V::length()), with_bounds);
}

gltf::Primitive GlbWriter::make_primitive(const Mesh& mesh) {
    if (mesh.deformation.points != no_index || !mesh.deformation.targets.empty() || mesh.deformation.skin != no_index ||
        mesh.subdivision.cage != no_index) {
        refuse("deforming meshes");
    }
    gltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = mesh.material;
    primitive.attributes["POSITION"] = add_vectors(mesh.positions, TINYGLTF_TYPE_VEC3, true);
    if (!mesh.normals.empty()) primitive.attributes["NORMAL"] = add_vectors(mesh.normals, TINYGLTF_TYPE_VEC3);
    if (!mesh.uv[0].empty()) primitive.attributes["TEXCOORD_0"] = add_vectors(mesh.uv[0], TINYGLTF_TYPE_VEC2);
    if (!mesh.uv[1].empty()) primitive.attributes["TEXCOORD_1"] = add_vectors(mesh.uv[1], TINYGLTF_TYPE_VEC2);
    if (!mesh.colors.empty()) primitive.attributes["COLOR_0"] = add_vectors(mesh.colors, TINYGLTF_TYPE_VEC4);
    gltf::Accessor indices;
    indices.bufferView = add_view(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.count = 3 * mesh.triangles.size();
    indices.type = TINYGLTF_TYPE_SCALAR;
    primitive.indices = static_cast<int>(model_.accessors.size());
    model_.accessors.push_back(indices);
    return primitive;
}

void GlbWriter::add_camera(const Camera& source) {
    gltf::Camera camera;
    camera.name = source.name;
    camera.type = source.orthographic ? "orthographic" : "perspective";
    if (source.orthographic) {
        camera.orthographic.ymag = camera.orthographic.xmag = constant(source.half_height, "half height");
        camera.orthographic.zfar = 1000.0;
    } else {
        camera.perspective.yfov = constant(source.fov, "field of view");
        camera.perspective.znear = 0.01;
        camera.perspective.zfar = 1000.0;
    }
    model_.cameras.push_back(camera);
}

void GlbWriter::add_light(const Light& source) {
    gltf::Light light;
    light.name = source.name;
    light.type = source.kind == Light::Kind::point  ? "point"
                 : source.kind == Light::Kind::spot ? "spot"
                                                    : "directional";
    light.color = numbers(constant(source.color, "light colour"));
    light.intensity = constant(source.intensity, "light intensity");
    light.range = constant(source.range, "light range");
    if (source.kind == Light::Kind::spot) {
        light.spot.innerConeAngle = constant(source.inner_cone, "cone");
        light.spot.outerConeAngle = constant(source.outer_cone, "cone");
    }
    use("KHR_lights_punctual");
    model_.lights.push_back(light);
}

namespace {

/// Turns about an axis become quaternions at the keys: below half a turn a key, slerp goes the same way.
Track<glm::dquat> as_quaternions(const AxisRotation& turn) {
    if (turn.angle.interpolation != Interpolation::linear && turn.angle.key_count() > 1) refuse("such turns");
    Track<glm::dquat> track;
    track.sampling = turn.angle.sampling;
    track.values.clear();
    for (std::size_t i = 0; i < turn.angle.key_count(); ++i) {
        if (i > 0 && std::abs(turn.angle.values[i] - turn.angle.values[i - 1]) > 3.0) refuse("turns so fast");
        track.values.push_back(glm::angleAxis(turn.angle.values[i], glm::normalize(turn.axis)));
    }
    return track;
}

}  // namespace

template <class T>
void GlbWriter::animate(int node, const char* path, const Track<T>& track) {
    if (track.key_count() == 1) return;
    std::vector<float> times, values;
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        times.push_back(static_cast<float>(sample_time(track.sampling, i)));
    }
    std::size_t components = 0;
    for (const T& value : track.values) {
        const std::vector<double> row = numbers(value);
        components = row.size();
        for (const double c : row) values.push_back(static_cast<float>(c));
    }
    gltf::AnimationSampler sampler;
    sampler.input = add_floats(times, TINYGLTF_TYPE_SCALAR, 1, true);
    sampler.output = add_floats(values, components == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, components, false);
    switch (track.interpolation) {
        case Interpolation::linear:
            sampler.interpolation = "LINEAR";
            break;
        case Interpolation::step:
            sampler.interpolation = "STEP";
            break;
        case Interpolation::cubic:
            sampler.interpolation = "CUBICSPLINE";
            break;
        default:
            refuse("nearest keys");
    }
    if (model_.animations.empty()) model_.animations.emplace_back();
    gltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(model_.animations[0].samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    model_.animations[0].samplers.push_back(sampler);
    model_.animations[0].channels.push_back(channel);
}

void GlbWriter::add_node(const Node& source) {
    const int index = static_cast<int>(model_.nodes.size());
    if (source.transform.operations || source.transform.matrix) refuse("matrices");
    if (source.visible.key_count() != 1 || source.visible.values[0] != 1.0) refuse("visibility");
    gltf::Node node;
    node.name = source.name;
    node.camera = source.camera;
    const Track<glm::dquat> rotation =
        source.transform.axis_rotation ? as_quaternions(*source.transform.axis_rotation) : source.transform.rotation;
    node.translation = numbers(key_value(source.transform.translation, 0));
    node.rotation = numbers(glm::normalize(key_value(rotation, 0)));
    node.scale = numbers(key_value(source.transform.scale, 0));
    if (source.light != no_index) {
        node.extensions["KHR_lights_punctual"] = gltf::Value(gltf::Value::Object{{"light", gltf::Value(source.light)}});
    }
    if (!source.meshes.empty()) {
        gltf::Mesh mesh;
        mesh.name = scene_.meshes[source.meshes[0]].name;
        for (const int i : source.meshes) {
            mesh.primitives.push_back(make_primitive(scene_.meshes[i]));
        }
        node.mesh = static_cast<int>(model_.meshes.size());
        model_.meshes.push_back(std::move(mesh));
    }
    model_.nodes.push_back(std::move(node));
    if (source.parent == no_index) {
        model_.scenes[0].nodes.push_back(index);
    } else {
        model_.nodes[source.parent].children.push_back(index);
    }
    animate(index, "translation", source.transform.translation);
    animate(index, "rotation", rotation);
    animate(index, "scale", source.transform.scale);
}

gltf::Model GlbWriter::write() {
    model_.asset.version = "2.0";
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    add_images();
    for (const Material& material : scene_.materials) add_material(material);
    for (const Camera& camera : scene_.cameras) add_camera(camera);
    for (const Light& light : scene_.lights) add_light(light);
    for (const Node& node : scene_.nodes) add_node(node);
    if (model_.buffers[0].data.empty()) model_.buffers.clear();
    return std::move(model_);
}

void write_glb(const Scene& scene, const std::filesystem::path& path) {
    gltf::Model model = GlbWriter(scene).write();
    std::ofstream stream(path, std::ios::binary);
    if (!gltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true) || !stream.flush()) {
        throw std::runtime_error("cannot write " + path.string());
    }
}

}  // namespace aleph
