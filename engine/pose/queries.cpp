// Properties of a scene that do not depend on time: its instances, its range, its cameras, whether it moves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/errors.h"
#include "engine/pose/pose.h"
#include "engine/scene/operations.h"
#include "engine/scene/points.h"
#include "engine/scene/visit.h"

namespace aleph {

std::vector<bool> nodes_with_content(const Scene& scene) {
    std::vector<bool> content(scene.nodes.size(), false);
    for (const Skin& skin : scene.skins)
        for (const int joint : skin.joints) content[joint] = true;
    for (std::size_t i = scene.nodes.size(); i-- > 0;) {
        const Node& node = scene.nodes[i];
        if (!node.meshes.empty() || node.light != no_index) content[i] = true;
        if (content[i] && node.parent != no_index) content[node.parent] = true;
    }
    return content;
}

std::vector<Instance> list_instances(const Scene& scene) {
    std::vector<Instance> instances;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const int mesh : scene.nodes[node].meshes) instances.push_back({static_cast<int>(node), mesh});
    return instances;
}

std::vector<std::uint8_t> list_ever_shown(const Scene& scene) {
    // Keys of visibility have no values between them.
    const auto most = [](const Track<double>& track) {
        double value = 0.0;
        for (std::size_t key = 0; key < track.key_count(); ++key)
            value = std::max(value, std::abs(key_value(track, key)));
        return value;
    };
    std::vector<std::uint8_t> nodes(scene.nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const double visible = most(node.visible);
        const int shown_by = visible >= 2.0 ? space_of(scene, node) : node.parent;
        nodes[n] = visible != 0.0 && (shown_by == no_index || nodes[shown_by] != 0);
    }
    std::vector<std::uint8_t> shown;
    for (const Instance& instance : list_instances(scene)) {
        shown.push_back(nodes[instance.node] != 0 && most(scene.meshes[instance.mesh].present) != 0.0);
    }
    return shown;
}

FrameRange frame_range(const Scene& scene) {
    if (scene.film.range) return *scene.film.range;
    double earliest = std::numeric_limits<double>::infinity(), latest = -earliest;
    const auto widen_samples = [&](const TimeSampling& sampling, std::size_t count) {
        if (count <= 1) return;
        earliest = std::min(earliest, sample_time(sampling, 0));
        latest = std::max(latest, sample_time(sampling, count - 1));
    };
    const auto visit = [&](const auto& property) { widen_samples(property.sampling, sample_count(property)); };
    visit_tracks(scene, visit);
    for (const Mesh& mesh : scene.meshes)
        widen_samples(mesh.deformation.normal_sampling, mesh.deformation.normal_samples.size());
    for (const PointCache& cache : scene.point_caches) widen_samples(cache.sampling, cache.positions.size());
    for (const CameraKey& key : scene.film.camera_keys) {
        earliest = std::min(earliest, scene.film.frame_rate.seconds_of(key.frame));
        latest = std::max(latest, scene.film.frame_rate.seconds_of(key.frame));
    }
    if (!(earliest <= latest)) return {};

    // A key within rounding of a frame is on it. Single-precision times are off by up to 6e-8 of themselves, and by
    // more where an exporter adds them up: by 8e-5 of a frame after 126 frames.
    const auto slack = [](double frame) { return 1e-3 + 1.2e-7 * std::abs(frame); };
    const double per_second = scene.film.frame_rate.per_second();
    constexpr auto limit = static_cast<double>(farthest_frame);
    const double begin = std::clamp(earliest * per_second, -limit, limit);
    const double end = std::clamp(latest * per_second, -limit, limit);
    const auto first = static_cast<std::int64_t>(std::ceil(begin - slack(begin)));
    const auto last = static_cast<std::int64_t>(std::floor(end + slack(end)));
    return {first, std::max(first, last)};  // keys that all lie between two frames: the frame after them
}

void change_frame_rate(Film& film, const FrameRate& rate) {
    constexpr double rounding = 1e-9;
    const double ratio = rate.per_second() / film.frame_rate.per_second();
    const auto first_after = [&](std::int64_t frame) {
        return static_cast<std::int64_t>(std::ceil(static_cast<double>(frame) * ratio - rounding));
    };
    film.frame_rate = rate;
    if (film.range) {
        const double last = std::floor(static_cast<double>(film.range->last) * ratio + rounding);
        film.range->first = first_after(film.range->first);
        film.range->last = std::max(film.range->first, static_cast<std::int64_t>(last));
    }
    for (std::int64_t& cut : film.cuts) cut = first_after(cut);
    film.cuts.erase(std::unique(film.cuts.begin(), film.cuts.end()), film.cuts.end());
    std::vector<CameraKey> keys;
    for (CameraKey& key : film.camera_keys) {
        key.frame = first_after(key.frame);
        if (!keys.empty() && keys.back().frame == key.frame) keys.pop_back();
        keys.push_back(std::move(key));
    }
    film.camera_keys = std::move(keys);
}

CameraNames::CameraNames(const Scene& scene) : scene_(scene) {
    for (const Node& node : scene.nodes) {
        if (node.camera == no_index) continue;
        nodes_.emplace(node.name, count_);
        cameras_.emplace(scene.cameras[node.camera].name, count_);
        ++count_;
    }
}

int CameraNames::find(const std::string& name) const {
    const Film& film = scene_.film;
    const std::string& chosen = film.camera_keys.empty() ? film.camera : film.camera_keys.front().camera;
    const std::string& wanted = name.empty() ? chosen : name;
    if (count_ == 0) throw InputError(scene_.source.file, "camera", "the scene has no camera");
    if (wanted.empty()) return 0;
    for (const auto& names : {&nodes_, &cameras_}) {
        if (const auto found = names->find(wanted); found != names->end()) return found->second;
    }
    std::string known;
    for (const Node& node : scene_.nodes) {
        if (node.camera == no_index) continue;
        const std::string& shown = node.name.empty() ? scene_.cameras[node.camera].name : node.name;
        known += fmt::format("{}'{}'", known.empty() ? "" : ", ", printable(shown));
    }
    throw InputError(scene_.source.file, "camera",
                     fmt::format("there is no camera '{}'; there is {}", printable(wanted), known));
}

std::vector<CameraShot> list_camera_shots(const Scene& scene, const std::string& name) {
    const CameraNames names(scene);
    std::vector<CameraShot> shots{{0, names.find(name)}};
    if (!name.empty()) return shots;
    for (const CameraKey& key : scene.film.camera_keys) {
        const int camera = names.find(key.camera);
        if (camera != shots.back().camera) shots.push_back({key.frame, camera});
    }
    return shots;
}

int camera_at(const std::vector<CameraShot>& shots, std::int64_t frame) {
    // The first shot holds before its frame too.
    const auto next = std::upper_bound(shots.begin() + 1, shots.end(), frame,
                                       [](std::int64_t f, const CameraShot& shot) { return f < shot.first; });
    return std::prev(next)->camera;
}

bool is_world_animated(const Scene& scene) {
    const std::vector<bool> content = nodes_with_content(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (content[i] && has_animated_tracks(scene.nodes[i])) return true;
    const auto are_samples_animated = [](const Mesh& mesh) {
        return do_samples_differ(mesh.deformation.normal_samples);
    };
    return std::ranges::any_of(scene.meshes, has_animated_tracks<Mesh>) ||
           std::ranges::any_of(scene.meshes, are_samples_animated) ||
           std::ranges::any_of(scene.point_caches, [](const PointCache& cache) { return is_animated(cache); }) ||
           std::ranges::any_of(scene.materials, has_animated_tracks<Material>) ||
           std::ranges::any_of(scene.lights, has_animated_tracks<Light>) || has_animated_tracks(scene.environment);
}

}  // namespace aleph
