#include "engine/load/validate_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/pose/pose.h"
#include "engine/scene/operations.h"
#include "engine/scene/visit.h"
#include "engine/surface/cage_checks.h"

namespace aleph {

namespace {

constexpr double unit_tolerance = 1e-6;

/// One element of the scene, for messages.
class Element {
  public:
    Element(const Scene& scene, const char* kind, std::size_t index, const std::string& name)
        : scene_(scene), place_(fmt::format("{} {}", kind, index)) {
        if (!name.empty()) place_ += fmt::format(" \"{}\"", printable(name));
    }

    [[noreturn]] void refuse(const std::string& reason) const { throw InputError(scene_.source.file, place_, reason); }
    void require(bool holds, const char* reason) const {
        if (!holds) refuse(reason);
    }

    /// @param what  the kind of element that is referred to
    void check_index(int index, std::size_t count, const char* what, bool optional = true) const {
        if (optional && index == no_index) return;
        if (index >= 0 && static_cast<std::size_t>(index) < count) return;
        refuse(fmt::format("refers to {} {}, but there {} {}", what, index, count == 1 ? "is" : "are",
                           count == 0 ? "none" : fmt::format("only {}", count)));
    }

    template <class T>
    void check_track(const Track<T>& track) const {
        aleph::validate(track, scene_.source.file, place_);
    }
    void check_track(const OperationStack& stack) const {
        if (stack.operations.empty()) return;
        const std::size_t width = channel_count(stack);
        require(!stack.channels.empty() && stack.channels.size() % width == 0,
                "its operations need as many channels for every sample");
        require(std::ranges::all_of(stack.channels, [](double v) { return std::isfinite(v); }),
                "a channel of its operations is not finite");
        aleph::validate(stack.sampling, sample_count(stack), scene_.source.file, place_);
    }
    void check_axis(const std::optional<AxisRotation>& rotation) const {
        if (!rotation) return;
        const double length = glm::length(rotation->axis);
        if (!(std::abs(length - 1.0) <= unit_tolerance)) {
            refuse(fmt::format("the axis of its rotation has length {}; it has to be a unit vector", length));
        }
    }

  private:
    const Scene& scene_;
    std::string place_;
};

/// Calls check(element for messages, element) for each of a list.
template <class List, class Check>
void check_each(const Scene& scene, const char* kind, const List& list, const Check& check) {
    for (std::size_t i = 0; i < list.size(); ++i) check(Element(scene, kind, i, list[i].name), list[i]);
}

bool is_positive(double value) {
    return std::isfinite(value) && value > 0.0;
}

void validate_shot(const Scene& scene) {
    const auto require = [&](bool holds, const char* place, const char* reason) {
        if (!holds) throw InputError(scene.source.file, place, reason);
    };
    require(scene.film.frame_rate.numerator > 0 && scene.film.frame_rate.denominator > 0, "frame rate",
            "both numbers have to be above 0");
    require(!scene.film.range || scene.film.range->first <= scene.film.range->last, "range",
            "its last frame is before its first");
    require(is_positive(scene.film.viewing.pixels_per_degree), "viewing", "pixels per degree have to be above 0");
    require(is_positive(scene.film.viewing.display_white), "viewing", "the luminance of white has to be above 0");
    require(is_positive(scene.film.viewing.persistence) && scene.film.viewing.persistence <= 1.0, "viewing",
            "persistence has to be above 0 and at most 1");
    require(!scene.film.exposure || is_positive(*scene.film.exposure), "exposure", "has to be above 0");
    const Element environment(scene, "environment", 0, "");
    visit_tracks(scene.environment, [&](const auto& track) { environment.check_track(track); });
    environment.check_axis(scene.environment.axis_rotation);
    environment.check_index(scene.environment.image, scene.images.size(), "image");
    if (scene.environment.image == no_index) return;
    environment.require(scene.environment.radiance.has_value(),
                        "a picture of the surroundings needs `environment`, its factor");
    environment.require(!scene.images[scene.environment.image].floats.empty(),
                        "the picture of the surroundings has no floating-point pixels");
}

void validate_camera_keys(const Scene& scene) {
    const CameraNames cameras(scene);
    for (std::size_t i = 0; i < scene.film.camera_keys.size(); ++i) {
        const Element at(scene, "camera key", i, scene.film.camera_keys[i].camera);
        at.require(i == 0 || scene.film.camera_keys[i].frame > scene.film.camera_keys[i - 1].frame,
                   "frames have to ascend");
        cameras.find(scene.film.camera_keys[i].camera);
    }
    const Element both(scene, "camera", 0, scene.film.camera);
    both.require(scene.film.camera.empty() || scene.film.camera_keys.empty(),
                 "either a camera or camera keys can be set");
}

void validate_nodes(const Scene& scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const Element at(scene, "node", i, node.name);
        at.check_index(node.parent, scene.nodes.size(), "parent");
        at.require(node.parent < static_cast<int>(i), "its parent has to stand before it");
        visit_tracks(node, [&](const auto& track) { at.check_track(track); });
        at.check_axis(node.transform.axis_rotation);
        for (const int mesh : node.meshes) at.check_index(mesh, scene.meshes.size(), "mesh", false);
        at.check_index(node.camera, scene.cameras.size(), "camera");
        at.check_index(node.light, scene.lights.size(), "light");
        at.check_index(node.include, scene.source.includes.size(), "include");
        at.check_index(space_of(scene, node), i + 1, "node of the include's content");
    }
}

void validate_materials(const Scene& scene) {
    check_each(scene, "material", scene.materials, [&](const Element& at, const Material& material) {
        visit_tracks(material, [&](const auto& track) { at.check_track(track); });
        for (const MaterialTexture& texture : material_textures) {
            const TextureRef& reference = material.textures[texture.slot];
            at.check_index(reference.image, scene.images.size(), "image");
            if (reference.uv_set != 0 && reference.uv_set != 1) {
                at.refuse(fmt::format("{}: texture coordinates 0 and 1 exist, not {}", texture.key, reference.uv_set));
            }
        }
    });
    check_each(scene, "image", scene.images, [&](const Element& at, const SceneImage& image) {
        at.require(image.bytes.empty() || image.floats.empty(), "has both 8-bit and floating-point pixels");
    });
}

void validate_lights_and_cameras(const Scene& scene) {
    check_each(scene, "light", scene.lights, [](const Element& at, const Light& light) {
        visit_tracks(light, [&](const auto& track) { at.check_track(track); });
    });
    check_each(scene, "camera", scene.cameras, [&](const Element& at, const Camera& camera) {
        visit_tracks(camera, [&](const auto& track) { at.check_track(track); });
        at.require(is_positive(camera.near_plane), "its near plane has to be above 0");
        at.require(
            std::isfinite(camera.shutter.x) && std::isfinite(camera.shutter.y) && camera.shutter.x <= camera.shutter.y,
            "its shutter has to close when it opens or later");
    });
}

void validate_motion_sources(const Scene& scene) {
    for (std::size_t i = 0; i < scene.point_caches.size(); ++i) {
        const PointCache& cache = scene.point_caches[i];
        const Element at(scene, "point cache", i, cache.name);
        at.require(!cache.positions.empty(), "has no samples");
        validate(cache.sampling, cache.positions.size(), scene.source.file, fmt::format("point cache {}", i));
        for (const auto& points : cache.positions) {
            at.require(points.size() == cache.point_count(), "its samples have different numbers of points");
            at.require(std::ranges::all_of(points, is_finite), "a point is not finite");
        }
    }
    check_each(scene, "skin", scene.skins, [&](const Element& at, const Skin& skin) {
        at.require(skin.joints.size() == skin.inverse_binds.size(), "needs one inverse bind matrix for each joint");
        for (const int joint : skin.joints) at.check_index(joint, scene.nodes.size(), "node", false);
    });
    check_each(scene, "cage", scene.cages, [&](const Element& at, const Cage& cage) {
        at.check_index(cage.points, scene.point_caches.size(), "point cache", false);
        validate(cage, scene.point_caches[cage.points].point_count());
    });
}

}  // namespace

void validate_mesh(const Scene& scene, int index) {
    const Mesh& mesh = scene.meshes[index];
    const Element at(scene, "mesh", static_cast<std::size_t>(index), mesh.name);
    const std::size_t count = mesh.positions.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    at.require(fits(mesh.normals.size()), "needs as many normals as positions, or none");
    at.require(fits(mesh.uv[0].size()) && fits(mesh.uv[1].size()),
               "needs as many texture coordinates as positions, or none");
    at.require(fits(mesh.colors.size()), "needs as many colours as positions, or none");
    at.require(fits(mesh.deformation.vertex_points.size()), "needs as many vertex_points as positions, or none");
    at.require(std::ranges::all_of(mesh.positions, is_finite), "a position is not finite");
    for (const glm::uvec3& triangle : mesh.triangles) {
        const std::uint32_t highest = std::max({triangle.x, triangle.y, triangle.z});
        if (highest >= count) at.refuse(fmt::format("a triangle has vertex {}, but there are {}", highest, count));
    }
    at.check_index(mesh.material, scene.materials.size(), "material");
    at.check_index(mesh.deformation.points, scene.point_caches.size(), "point cache");
    at.check_index(mesh.subdivision.cage, scene.cages.size(), "cage");
    at.check_index(mesh.deformation.skin, scene.skins.size(), "skin");
    visit_tracks(mesh, [&](const Track<double>& track) { at.check_track(track); });
    if (mesh.deformation.points != no_index) {
        const std::size_t points = scene.point_caches[mesh.deformation.points].point_count();
        at.require(!mesh.deformation.vertex_points.empty() || count <= points,
                   "has more vertices than its point cache has points");
        for (const std::uint32_t point : mesh.deformation.vertex_points) {
            if (point >= points) at.refuse(fmt::format("a vertex uses point {}, but the cache has {}", point, points));
        }
    }
    for (const auto& normals : mesh.deformation.normal_samples) {
        at.require(normals.size() == count, "a sample of its normals has another number of them than of positions");
    }
    if (!mesh.deformation.normal_samples.empty()) {
        validate(mesh.deformation.normal_sampling, mesh.deformation.normal_samples.size(), scene.source.file,
                 fmt::format("mesh {}", index));
    }
    at.require(mesh.deformation.target_weights.size() == mesh.deformation.targets.size(),
               "needs one weight track for each morph target");
    for (const MorphTarget& target : mesh.deformation.targets) {
        at.require(fits(target.positions.size()) && fits(target.normals.size()),
                   "a morph target needs as many displacements as the mesh has positions, or none");
    }
    if (mesh.deformation.skin == no_index) return;
    at.require(mesh.deformation.joints_per_vertex > 0 &&
                   mesh.deformation.joint_weights.size() ==
                       count * static_cast<std::size_t>(mesh.deformation.joints_per_vertex),
               "needs joints_per_vertex weights for each vertex");
    const std::size_t joints = scene.skins[mesh.deformation.skin].joints.size();
    for (const JointWeight& weight : mesh.deformation.joint_weights) {
        at.check_index(static_cast<int>(weight.joint), joints, "joint", false);
    }
}

void validate(const Scene& scene) {
    validate_shot(scene);
    validate_nodes(scene);
    validate_camera_keys(scene);
    validate_materials(scene);
    validate_lights_and_cameras(scene);
    validate_motion_sources(scene);
    for (int i = 0; i < std::ssize(scene.meshes); ++i) validate_mesh(scene, i);
}

}  // namespace aleph
