#include "engine/load/validate_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/color.h"
#include "engine/load/checked_element.h"
#include "engine/pose/pose.h"
#include "engine/scene/visit.h"
#include "engine/surface/cage_checks.h"

namespace aleph {

namespace {

constexpr const char* frame_fault = "frames have to lie within 9e15 of 0";
constexpr ValueRange subdivision_levels{0.0, max_subdivision_level};

/// Calls check(element for messages, element) for each of a list.
template <class List, class Check>
void check_each(const Scene& scene, const char* kind, const List& list, const Check& check) {
    for (std::size_t i = 0; i < list.size(); ++i) check(CheckedElement(scene, kind, i, list[i].name), list[i]);
}

void validate_film(const Scene& scene) {
    const Film& film = scene.film;
    const FrameRate& rate = film.frame_rate;
    CheckedElement(scene, "frame rate")
        .require(rate.numerator > 0 && rate.denominator > 0, "both numbers have to be above 0");
    if (film.range) {
        const CheckedElement at(scene, "range");
        at.require(film.range->first <= film.range->last, "its last frame is before its first");
        at.require(is_frame(film.range->first) && is_frame(film.range->last), frame_fault);
    }
    CheckedElement(scene, "cuts").require(std::ranges::all_of(film.cuts, is_frame), frame_fault);
    CheckedElement(scene, "viewing").check(film.viewing, viewing_numbers);
    if (film.exposure && !above_zero.holds(*film.exposure))
        CheckedElement(scene, "exposure").refuse(describe_outside(above_zero, *film.exposure));
}

void validate_environment(const Scene& scene) {
    const Environment& environment = scene.environment;
    const CheckedElement at(scene, "environment", 0, "");
    visit_tracks(environment, [&](const auto& track) { at.check_track(track); });
    at.check_axis(environment.axis_rotation);
    if (environment.radiance) at.check_keys("radiance", *environment.radiance, environment_range);
    at.check_index(environment.image, scene.images.size(), "image");
    if (environment.image == no_index) return;
    at.require(environment.radiance.has_value(), "a picture of the surroundings needs `environment`, its factor");
    at.require(!scene.images[environment.image].floats.empty(),
               "the picture of the surroundings has no floating-point pixels");
}

void validate_camera_keys(const Scene& scene) {
    const CameraNames cameras(scene);
    for (std::size_t i = 0; i < scene.film.camera_keys.size(); ++i) {
        const CameraKey& key = scene.film.camera_keys[i];
        const CheckedElement at(scene, "camera key", i, key.camera);
        at.require(is_frame(key.frame), frame_fault);
        at.require(i == 0 || key.frame > scene.film.camera_keys[i - 1].frame, "frames have to ascend");
        cameras.find(key.camera);
    }
    const CheckedElement both(scene, "camera", 0, scene.film.camera);
    both.require(scene.film.camera.empty() || scene.film.camera_keys.empty(),
                 "either a camera or camera keys can be set");
}

void validate_nodes(const Scene& scene) {
    std::vector<std::uint8_t> has_node(scene.meshes.size(), 0);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const CheckedElement at(scene, "node", i, node.name);
        at.check_index(node.parent, scene.nodes.size(), "parent");
        at.require(node.parent < static_cast<int>(i), "its parent has to stand before it");
        visit_tracks(node, [&](const auto& track) { at.check_track(track); });
        at.check_words("visible", node.visible, 2);
        at.check_words("inherits", node.inherits, 1);
        at.check_axis(node.transform.axis_rotation);
        for (const int mesh : node.meshes) {
            at.check_index(mesh, scene.meshes.size(), "mesh", false);
            if (scene.meshes[mesh].deformation.skin == no_index) continue;
            if (has_node[mesh]++ != 0) at.refuse(fmt::format("mesh {} has a skin and another node already", mesh));
        }
        at.check_index(node.camera, scene.cameras.size(), "camera");
        at.check_index(node.light, scene.lights.size(), "light");
        at.check_index(node.include, scene.source.includes.size(), "include");
        at.check_index(space_of(scene, node), i + 1, "node of the include's content");
    }
    for (std::size_t i = 0; i < scene.source.includes.size(); ++i) {
        const Include& include = scene.source.includes[i];
        CheckedElement(scene, "include", i, include.path).check_index(include.node, scene.nodes.size(), "node");
    }
}

template <class Pixels>
bool is_whole(const Image<Pixels>& image) {
    return image.width >= 0 && image.height >= 0 && image.size() == image.index(0, image.height);
}

void validate_materials(const Scene& scene) {
    check_each(scene, "material", scene.materials, [&](const CheckedElement& at, const Material& material) {
        visit_tracks(material, [&](const auto& track) { at.check_track(track); });
        at.check(material, material_numbers);
        at.check(material, material_colors);
        at.check(material, material_scales);
        at.check_number("alpha_cutoff", material.opacity.cutoff, not_negative);
        for (const MaterialTexture& texture : material_textures)
            at.check_texture(texture.key, material.textures[texture.slot], scene.images.size());
    });
    check_each(scene, "image", scene.images, [&](const CheckedElement& at, const SceneImage& image) {
        at.require(image.bytes.empty() || image.floats.empty(), "has both 8-bit and floating-point pixels");
        at.require(!image.bytes.empty() || !image.floats.empty(), "has no pixels");
        at.require(is_whole(image.bytes) && is_whole(image.floats), "needs width * height pixels");
    });
}

void validate_lights_and_cameras(const Scene& scene) {
    check_each(scene, "light", scene.lights, [](const CheckedElement& at, const Light& light) {
        visit_tracks(light, [&](const auto& track) { at.check_track(track); });
        at.check(light, light_colors);
        at.check(light, light_numbers);
        at.check(light, light_cones);
        if (const char* fault = fault_of_cones(light)) at.refuse(fault);
    });
    check_each(scene, "camera", scene.cameras, [&](const CheckedElement& at, const Camera& camera) {
        visit_tracks(camera, [&](const auto& track) { at.check_track(track); });
        // A focus distance counts with an aperture only: find_lens (render/frame/shot.h) checks it where it is used.
        for (const auto& field : camera_numbers)
            if (&field.in(camera) != &camera.focus_distance) at.check_keys(field.key, field.in(camera), field.range);
        at.check(camera, camera_angles);
        at.check(camera, camera_lengths);
        at.check_number("shutter", camera.shutter.x, any_value);
        at.check_number("shutter", camera.shutter.y, any_value);
        at.require(camera.shutter.x <= camera.shutter.y, "its shutter has to close when it opens or later");
    });
}

void validate_motion_sources(const Scene& scene) {
    check_each(scene, "point cache", scene.point_caches, [](const CheckedElement& at, const PointCache& cache) {
        at.require(!cache.positions.empty(), "has no samples");
        at.check_sampling(cache.sampling, cache.positions.size());
        for (const auto& points : cache.positions) {
            at.require(points.size() == cache.point_count(), "its samples have different numbers of points");
            at.require(std::ranges::all_of(points, is_finite), "a point is not finite");
        }
    });
    check_each(scene, "skin", scene.skins, [&](const CheckedElement& at, const Skin& skin) {
        at.require(skin.joints.size() == skin.inverse_binds.size(), "needs one inverse bind matrix for each joint");
        for (const int joint : skin.joints) at.check_index(joint, scene.nodes.size(), "node", false);
        for (const glm::dmat4& bind : skin.inverse_binds) at.check_track(Track<glm::dmat4>(bind));
    });
    check_each(scene, "cage", scene.cages, [&](const CheckedElement& at, const Cage& cage) {
        at.check_index(cage.points, scene.point_caches.size(), "point cache", false);
        at.check_number("level", cage.level, subdivision_levels);
        at.check_number("max_level", cage.max_level, subdivision_levels);
        validate(cage, scene.point_caches[cage.points].point_count());
    });
}

/// Meshes and cages are valid by themselves.
void validate_parts(const Scene& scene) {
    std::vector<int> parts;
    for (const Cage& cage : scene.cages) parts.push_back(count_parts(cage));
    check_each(scene, "mesh", scene.meshes, [&](const CheckedElement& at, const Mesh& mesh) {
        if (mesh.subdivision.cage == no_index) return;
        const auto count = static_cast<std::size_t>(parts[mesh.subdivision.cage]);
        at.check_index(mesh.subdivision.part, count, "part of its cage", false);
    });
}

}  // namespace

void validate(const Scene& scene) {
    validate_film(scene);
    validate_environment(scene);
    validate_nodes(scene);
    validate_camera_keys(scene);
    validate_materials(scene);
    validate_lights_and_cameras(scene);
    validate_motion_sources(scene);
    for (int i = 0; i < std::ssize(scene.meshes); ++i) validate_mesh(scene, i);
    validate_parts(scene);
}

}  // namespace aleph
