// The keyed properties of nodes, materials, lights and cameras.

#include <fmt/format.h>

#include "engine/scene/operations.h"
#include "engine/scene/points.h"
#include "engine/scene_file/fields.h"
#include "render/cli/explain/explain.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

ordered_json describe_sampling(const TimeSampling& sampling, std::size_t keys) {
    ordered_json out;
    switch (sampling.kind) {
        case TimeSampling::Kind::uniform:
            out = {{"sampling", "uniform"}, {"start", sampling.start}, {"period", sampling.period}};
            break;
        case TimeSampling::Kind::cyclic:
            out = {{"sampling", "cyclic"}, {"period", sampling.period}, {"samples_per_cycle", sampling.times.size()}};
            break;
        case TimeSampling::Kind::acyclic:
            out = {{"sampling", "acyclic"}};
            break;
    }
    out["keys"] = keys;
    out["first"] = sample_time(sampling, 0);
    out["last"] = sample_time(sampling, keys - 1);
    return out;
}

class TrackList {
  public:
    template <class T>
    void add(const std::string& property, const Track<T>& track) {
        add(property, track.sampling, track.key_count(), track.interpolation, is_animated(track));
    }

    template <class Element, class Fields>
    void add_all(const Element& element, const Fields& fields) {
        for (const auto& field : fields) add(field.key, field.in(element));
    }

    void add(const std::string& property, const TimeSampling& sampling, std::size_t samples,
             Interpolation interpolation, bool animated) {
        if (samples <= 1) return;
        ordered_json item = {{"property", property}};
        item.update(describe_sampling(sampling, samples));
        item["interpolation"] = interpolation_words[index_of(interpolation)];
        if (!animated) item["constant"] = true;
        tracks_.push_back(std::move(item));
    }

    ordered_json take() { return std::move(tracks_); }

  private:
    ordered_json tracks_ = ordered_json::array();
};

void add_rotation(TrackList& list, const std::string& key, const Track<glm::dquat>& rotation,
                  const std::optional<AxisRotation>& about_axis) {
    if (about_axis) {
        list.add(key + ".degrees", about_axis->angle);
    } else {
        list.add(key, rotation);
    }
}

void add_transform(TrackList& list, const Node& node) {
    const LocalTransform& local = node.transform;
    if (local.operations) {
        list.add("operations", local.operations->sampling, sample_count(*local.operations), Interpolation::linear,
                 is_animated(*local.operations));
    } else if (local.matrix) {
        list.add("matrix", *local.matrix);
    } else {
        list.add("translation", local.translation);
        add_rotation(list, "rotation", local.rotation, local.axis_rotation);
        list.add("scale", local.scale);
    }
    list.add("inherits", node.inherits);
    list.add("visible", node.visible);
}

}  // namespace

ordered_json list_tracks(const Scene& scene, const Node& node) {
    TrackList list;
    add_transform(list, node);
    int points_listed = no_index;
    for (const int index : node.meshes) {
        const Mesh& mesh = scene.meshes[index];
        list.add("present", mesh.present);
        for (std::size_t i = 0; i < mesh.deformation.target_weights.size(); ++i)
            list.add(fmt::format("weights[{}]", i), mesh.deformation.target_weights[i]);
        list.add("normals", mesh.deformation.normal_sampling, mesh.deformation.normal_samples.size(),
                 Interpolation::linear, true);
        const int points =
            mesh.subdivision.cage == no_index ? mesh.deformation.points : scene.cages[mesh.subdivision.cage].points;
        if (points == no_index || points == points_listed) continue;
        points_listed = points;
        const PointCache& cache = scene.point_caches[points];
        list.add("points", cache.sampling, cache.positions.size(), Interpolation::linear, is_animated(cache));
    }
    return list.take();
}

ordered_json list_tracks(const Material& material) {
    TrackList list;
    list.add_all(material, material_colors);
    list.add_all(material, material_numbers);
    list.add_all(material, material_angles);
    return list.take();
}

ordered_json list_environment_tracks(const Scene& scene) {
    TrackList list;
    if (scene.environment.radiance) list.add("environment", *scene.environment.radiance);
    add_rotation(list, "environment_rotation", scene.environment.rotation, scene.environment.axis_rotation);
    return list.take();
}

ordered_json list_tracks(const Light& light) {
    TrackList list;
    list.add("color", light.color);
    list.add("intensity", light.intensity);
    list.add_all(light, light_cones);
    list.add("range", light.range);
    return list.take();
}

ordered_json list_tracks(const Camera& camera) {
    TrackList list;
    list.add_all(camera, camera_angles);
    list.add_all(camera, camera_numbers);
    return list.take();
}

}  // namespace aleph
