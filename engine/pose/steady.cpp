#include "engine/pose/steady.h"

#include <algorithm>
#include <numeric>

#include "engine/scene/points.h"
#include "engine/scene/visit.h"

namespace aleph {
namespace {

/// Samples that have an influence in a span of time.
struct SampleRange {
    std::size_t first = 0, last = 0;
};

SampleRange find_range(const TimeSampling& sampling, std::size_t count, double from, double to) {
    return {find_samples(sampling, count, from).floor, find_samples(sampling, count, to).ceil};
}

template <class T>
SampleRange find_range(const Track<T>& track, double from, double to) {
    const std::size_t keys = track.key_count();
    if (track.interpolation == Interpolation::nearest) {
        return {nearest_sample(track.sampling, keys, from), nearest_sample(track.sampling, keys, to)};
    }
    SampleRange range = find_range(track.sampling, keys, from, to);
    if (track.interpolation == Interpolation::step) range.last = find_samples(track.sampling, keys, to).floor;
    return range;
}

template <class T>
bool is_steady(const Track<T>& track, double from, double to) {
    const auto [first, last] = find_range(track, from, to);
    return !do_keys_differ(track, first, last);
}

bool is_steady(const OperationStack& stack, double from, double to) {
    const auto [first, last] = find_range(stack.sampling, sample_count(stack), from, to);
    return !do_samples_differ(stack, first, last);
}

template <class Samples>
bool are_samples_steady(const TimeSampling& sampling, const Samples& samples, double from, double to) {
    const auto [first, last] = find_range(sampling, samples.size(), from, to);
    for (std::size_t i = first + 1; i <= last; ++i) {
        if (samples[i] != samples[i - 1]) return false;
    }
    return true;
}

template <class Element>
bool has_steady_tracks(const Element& element, double from, double to) {
    bool steady = true;
    visit_tracks(element, [&](const auto& track) { steady = steady && is_steady(track, from, to); });
    return steady;
}

template <class Element>
bool are_steady(const std::vector<Element>& elements, const std::vector<int>& which, double from, double to) {
    return std::ranges::all_of(which, [&](int i) { return has_steady_tracks(elements[i], from, to); });
}

bool is_mesh_steady(const Mesh& mesh, double from, double to) {
    return has_steady_tracks(mesh, from, to) &&
           are_samples_steady(mesh.deformation.normal_sampling, mesh.deformation.normal_samples, from, to);
}

void sort_unique(std::vector<int>& list) {
    std::ranges::sort(list);
    // Clang 14 cannot read std::ranges::unique.
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

SteadySpans::SteadySpans(const Scene& scene, const PosePlan& plan)
    : scene_(scene), materials_(plan.materials), changes_(is_world_animated(scene) || !plan.cameras.empty()) {
    const std::vector<bool> content = nodes_with_content(scene);
    std::ranges::copy_if(plan.nodes, std::back_inserter(nodes_), [&](int node) { return content[node]; });
    const std::vector<Instance> instances = list_instances(scene);
    for (const int i : plan.instances) meshes_.push_back(instances[i].mesh);
    sort_unique(meshes_);
    for (const int m : meshes_) {
        const Mesh& mesh = scene.meshes[m];
        if (mesh.deformation.points != no_index) point_caches_.push_back(mesh.deformation.points);
        if (mesh.subdivision.cage != no_index) point_caches_.push_back(scene.cages[mesh.subdivision.cage].points);
    }
    std::erase(point_caches_, no_index);
    sort_unique(point_caches_);
    if (plan.lights) {
        lights_.resize(scene.lights.size());
        std::iota(lights_.begin(), lights_.end(), 0);
    }
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].camera == no_index) continue;
        CameraTracks& tracks = cameras_.emplace_back(CameraTracks{scene.nodes[n].camera, {}});
        for (int node = static_cast<int>(n); node != no_index; node = scene.nodes[node].parent) {
            if (plan.moving[node] != 0) tracks.nodes.push_back(node);
        }
    }
}

bool SteadySpans::is_steady(int camera, double from, double to) const {
    if (!changes_) return true;
    const CameraTracks& looks = cameras_[camera];
    return are_steady(scene_.nodes, looks.nodes, from, to) &&
           has_steady_tracks(scene_.cameras[looks.camera], from, to) && is_world_steady(from, to);
}

bool SteadySpans::is_world_steady(double from, double to) const {
    if (!changes_) return true;
    return are_steady(scene_.nodes, nodes_, from, to) && are_steady(scene_.materials, materials_, from, to) &&
           are_steady(scene_.lights, lights_, from, to) && has_steady_tracks(scene_.environment, from, to) &&
           std::ranges::all_of(meshes_, [&](int m) { return is_mesh_steady(scene_.meshes[m], from, to); }) &&
           std::ranges::all_of(point_caches_, [&](int c) {
               const PointCache& cache = scene_.point_caches[c];
               return are_samples_steady(cache.sampling, cache.positions, from, to);
           });
}

std::vector<double> find_key_times(const Scene& scene, double from, double to) {
    constexpr std::size_t most = 256;
    std::vector<double> times;
    visit_tracks(scene, [&](const auto& property) {
        const std::size_t count = sample_count(property);
        if (count < 2) return;
        for (std::size_t i = find_samples(property.sampling, count, from).floor; i < count; ++i) {
            const double at = sample_time(property.sampling, i);
            if (at >= to) break;
            if (at > from) times.push_back(at);
        }
    });
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::vector<double> chosen;
    const std::size_t step = times.size() / most + 1;
    for (std::size_t i = 0; i < times.size(); i += step) chosen.push_back(times[i]);
    return chosen;
}

}  // namespace aleph
