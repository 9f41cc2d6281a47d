#include "engine/scene/scene_hash.h"

#include <OpenImageIO/hash.h>

#include <type_traits>

#include "engine/scene/visit.h"

namespace aleph {

namespace {

/// Types without padding, hashed as their bytes.
template <class T>
inline constexpr bool is_flat = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <glm::length_t n, class T, glm::qualifier q>
inline constexpr bool is_flat<glm::vec<n, T, q>> = true;
template <glm::length_t n, glm::length_t m, class T, glm::qualifier q>
inline constexpr bool is_flat<glm::mat<n, m, T, q>> = true;
template <class T, glm::qualifier q>
inline constexpr bool is_flat<glm::qua<T, q>> = true;
template <>
inline constexpr bool is_flat<JointWeight> = sizeof(JointWeight) == 2 * sizeof(float);

/// Hashes elements field by field. The structured bindings do not compile if a field is added: decide then whether it
/// counts.
class SceneHash {
  public:
    std::string digest() { return sha_.digest(); }

    void add(const Scene& scene) {
        const auto& [source, film, environment, nodes, meshes, point_caches, skins, cages, materials, images, lights,
                     cameras] = scene;
        add_all(film, environment, nodes, meshes, point_caches, skins, cages, materials, images, lights, cameras);
    }

  private:
    template <class... T>
    void add_all(const T&... fields) {
        (add(fields), ...);
    }

    template <class T>
    requires is_flat<T>
    void add(const T& value) { sha_.append(&value, sizeof value); }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        if constexpr (is_flat<T>) {
            sha_.append(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) add(value);
        }
    }
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
    template <class T>
    void add(const Image<T>& image) {
        add_all(image.width, image.height, image.pixels);
    }
    template <class T>
    void add(const Track<T>& track) {
        const auto& [sampling, interpolation, values] = track;
        add_all(sampling, interpolation, values);
    }

    void add(const TimeSampling& s) {
        const auto& [kind, start, period, times] = s;
        add_all(kind, start, period, times);
    }
    void add(const FrameRate& rate) { add_all(rate.numerator, rate.denominator); }
    void add(const FrameRange& range) { add_all(range.first, range.last); }
    void add(const ViewingConditions& viewing) {
        const auto& [pixels_per_degree, display_white, persistence] = viewing;
        add_all(pixels_per_degree, display_white, persistence);
    }
    void add(const AxisRotation& rotation) { add_all(rotation.axis, rotation.angle); }
    void add(const OperationStack& stack) {
        const auto& [operations, sampling, channels] = stack;
        add_all(operations, sampling, channels);
    }
    void add(const Film& film) {
        const auto& [frame_rate, range, cuts, camera, camera_keys, exposure, viewing] = film;
        add_all(frame_rate, range, cuts, viewing, exposure);
    }
    void add(const Environment& environment) {
        const auto& [radiance, image, rotation, axis_rotation] = environment;
        add_all(radiance, image, rotation, axis_rotation);
    }
    void add(const LocalTransform& transform) {
        const auto& [translation, rotation, axis_rotation, scale, matrix, operations] = transform;
        add_all(translation, rotation, axis_rotation, scale, matrix, operations);
    }
    void add(const Node& node) {
        const auto& [name, parent, transform, inherits, visible, meshes, camera, light, include] = node;
        add_all(parent, transform, inherits, visible, meshes, camera, light);
    }
    void add(const Deformation& deformation) {
        const auto& [points, vertex_points, normal_sampling, normal_samples, targets, target_weights, skin,
                     joint_weights, joints_per_vertex] = deformation;
        add_all(points, vertex_points, normal_sampling, normal_samples, targets, target_weights, skin, joint_weights,
                joints_per_vertex);
    }
    void add(const MeshSubdivision& subdivision) {
        const auto& [cage, part, limit] = subdivision;
        add_all(cage, part);
    }
    void add(const Mesh& mesh) {
        const auto& [name, positions, normals, uv, colors, triangles, material, shape, deformation, subdivision,
                     present, include] = mesh;
        add_all(positions, normals, uv[0], uv[1], colors, triangles, material, deformation, subdivision, present);
    }
    void add(const PointCache& cache) { add_all(cache.sampling, cache.positions); }
    void add(const MorphTarget& target) { add_all(target.positions, target.normals); }
    void add(const Skin& skin) { add_all(skin.joints, skin.inverse_binds); }
    void add(const Cage& cage) {
        const auto& [name, scheme, boundary, uv_rule, faces, creases, corners, uv, points, level, max_level, include] =
            cage;
        const auto& [face_sizes, face_points, holes, face_uv, face_parts] = faces;
        const auto& [crease_lengths, crease_points, crease_sharpness] = creases;
        const auto& [corner_points, corner_sharpness] = corners;
        add_all(scheme, boundary, uv_rule, face_sizes, face_points, holes, crease_lengths, crease_points,
                crease_sharpness, corner_points, corner_sharpness, uv, face_uv, face_parts, points, level, max_level);
    }
    void add(const SceneImage& image) { add_all(image.bytes, image.floats); }
    void add(const TextureRef& texture) {
        const auto& [image, uv_set, wrap_u, wrap_v, nearest, uv_offset, uv_scale, uv_rotation] = texture;
        add_all(image, uv_set, wrap_u, wrap_v, nearest, uv_offset, uv_scale, uv_rotation);
    }
    void add(const Material& m) {
        visit_tracks(m, [this](const auto& track) { add(track); });
        add_all(m.textures.normal_scale, m.textures.clearcoat_normal_scale, m.opacity.mode, m.opacity.cutoff, m.unlit,
                m.double_sided);
        for (const TextureRef& texture : m.textures.all) add(texture);
    }
    void add(const Light& light) {
        add(light.kind);
        visit_tracks(light, [this](const auto& track) { add(track); });
    }
    void add(const Camera& camera) {
        add_all(camera.orthographic, camera.near_plane, camera.shutter);
        visit_tracks(camera, [this](const auto& track) { add(track); });
    }

    OIIO::SHA1 sha_;
};

}  // namespace

std::string hash_scene(const Scene& scene) {
    SceneHash hash;
    hash.add(scene);
    return hash.digest();
}

std::string hash_bytes(std::string_view bytes) {
    return OIIO::SHA1::digest(bytes.data(), bytes.size());
}

}  // namespace aleph
