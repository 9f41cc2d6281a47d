#include "engine/rays/ray_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/base/flush_denormals.h"
#include "engine/rays/state.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

/// The layer of the objects from `first` up to `end`.
Layer make_layer(const MeshStructures& meshes, std::size_t first, std::size_t end,
                 const std::vector<std::unique_ptr<RefitMesh>>& refits) {
    Layer layer;
    layer.first = first;
    layer.top = meshes.device->make_scene(RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_MEDIUM);
    layer.placements.resize(end - first);
    for (std::size_t i = first; i < end; ++i) {
        const MeshStructures::Object& object = meshes.objects[i];
        EmbreeGeometry& placed = layer.placements[i - first].geometry;
        placed = meshes.device->make_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
        RTCGeometry geometry = placed.get();
        rtcSetGeometryInstancedScene(
            geometry, object.deforming == no_index ? object.mesh_scene : refits[object.deforming]->scene());
        rtcSetGeometryTimeStepCount(geometry, 1);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(layer.top.get(), geometry, static_cast<unsigned>(i));
        rtcDisableGeometry(geometry);
    }
    rtcCommitScene(layer.top.get());
    meshes.device->check();
    return layer;
}

/// Column by column: RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR.
std::array<float, 12> make_transform(const glm::dmat4& world, const glm::dvec3& anchor) {
    std::array<float, 12> transform{};
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            const double value = column < 3 ? world[column][row] : world[3][row] - anchor[row];
            transform[column * 3 + row] = static_cast<float>(value);
        }
    }
    return transform;
}

/// Moves the points of deforming meshes as posed.
std::vector<RefitMesh::Change> refit_meshes(RayScene::State& state, const ScenePose& posed) {
    std::vector<RefitMesh::Change> changes(state.refits.size(), RefitMesh::Change::none);
    for (std::size_t d = 0; d < changes.size(); ++d) {
        const DeformingMesh& mesh = state.meshes->deforming[d];
        if (!mesh.changes && state.refits[d]->is_filled()) continue;
        changes[d] = state.refits[d]->update(posed.meshes[mesh.mesh].positions);
    }
    return changes;
}

/// Notes the materials' alpha, which the filters of alpha masks read.
void note_alpha(RayScene::State& state, const ScenePose& posed) {
    if (!state.meshes->any_cutout) return;
    state.alpha.clear();
    for (const MaterialValues& material : posed.materials) state.alpha.push_back(material.alpha);
}

/// Places one object. @return whether anything changed
bool place(Layer& layer, Placement& placement, const MeshStructures::Object& object, RefitMesh::Change change,
           const ScenePose& posed, const glm::dvec3& anchor) {
    const glm::dmat4& world = posed.world[object.node];
    const bool shown = posed.shown[object.instance] != 0;
    const bool enabled = shown && change != RefitMesh::Change::unusable && is_traceable(world, anchor);
    const bool skipped = shown && !enabled;
    layer.skipped = layer.skipped + (skipped ? 1 : 0) - (placement.skipped ? 1 : 0);
    placement.skipped = skipped;
    const std::array<float, 12> transform = make_transform(world, anchor);
    const bool same = transform == placement.transform && change == RefitMesh::Change::none;
    if (enabled == placement.enabled && (!enabled || same)) return false;
    if (enabled) {
        rtcSetGeometryTransform(placement.geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
        rtcCommitGeometry(placement.geometry.get());
    }
    if (enabled && !placement.enabled) {
        rtcEnableGeometry(placement.geometry.get());
        ++layer.enabled;
    }
    if (!enabled && placement.enabled) {
        rtcDisableGeometry(placement.geometry.get());
        --layer.enabled;
    }
    placement.enabled = enabled;
    placement.transform = transform;
    return true;
}

/// Places the layer's first `count` objects. @return how many changed
std::size_t place_objects(Layer& layer, std::size_t count, const MeshStructures& meshes,
                          const std::vector<RefitMesh::Change>& changes, const ScenePose& posed,
                          const glm::dvec3& anchor) {
    std::size_t touched = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const MeshStructures::Object& object = meshes.objects[layer.first + i];
        const RefitMesh::Change change =
            object.deforming == no_index ? RefitMesh::Change::none : changes[object.deforming];
        if (place(layer, layer.placements[i], object, change, posed, anchor)) ++touched;
    }
    if (touched > 0) rtcCommitScene(layer.top.get());
    meshes.device->check();
    return touched;
}

}  // namespace

RayScene::State::State(std::shared_ptr<const MeshStructures> shared) : meshes(std::move(shared)) {
    for (const DeformingMesh& mesh : meshes->deforming)
        refits.push_back(std::make_unique<RefitMesh>(*meshes->device, mesh));
    moving = make_layer(*meshes, 0, meshes->first_layer_count, refits);
    still = make_layer(*meshes, meshes->first_layer_count, meshes->objects.size(), refits);
}

bool is_traceable(const glm::dmat4& world, const glm::dvec3& anchor) {
    if (!has_full_rank(world)) return false;
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(world));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(inverse[column][row]));
    }
    const glm::dvec3 moved = glm::abs(inverse * (glm::dvec3(world[3]) - anchor));
    return 3.0 * largest * max_ray_component + std::max({moved.x, moved.y, moved.z}) < max_coordinate;
}

bool are_traceable(const std::vector<glm::dvec3>& positions) {
    return std::ranges::all_of(positions, [](const glm::dvec3& given) {
        const glm::vec3 p(given);  // NaN fails every comparison
        return std::abs(p.x) < max_coordinate && std::abs(p.y) < max_coordinate && std::abs(p.z) < max_coordinate;
    });
}

RayScene::RayScene(const Scene& scene, const PosePlan& plan)
    : state_(new State(std::make_shared<MeshStructures>(scene, plan))) {}
RayScene::RayScene(const Scene& scene) : RayScene(scene, make_pose_plan(scene)) {}
RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

RayScene RayScene::share_meshes() const {
    return RayScene(std::make_unique<State>(state_->meshes));
}

std::size_t RayScene::update(const ScenePose& posed, const glm::dvec3& anchor) {
    const FlushDenormals flush;
    note_alpha(*state_, posed);
    const std::vector<RefitMesh::Change> changes = refit_meshes(*state_, posed);
    std::size_t touched = 0;
    for (Layer* layer : {&state_->moving, &state_->still})
        touched += place_objects(*layer, layer->placements.size(), *state_->meshes, changes, posed, anchor);
    if (!state_->placed || anchor != state_->anchor) touched += state_->meshes->flat_count;
    state_->anchor = anchor;
    state_->flat_shift = glm::vec3(anchor - state_->meshes->flat_origin);
    state_->placed = true;
    return touched;
}

std::size_t RayScene::update_moving(const ScenePose& posed, const glm::dvec3& anchor) {
    if (!state_->placed || anchor != state_->anchor) return update(posed, anchor);
    const FlushDenormals flush;
    note_alpha(*state_, posed);
    const MeshStructures& meshes = *state_->meshes;
    return place_objects(state_->moving, meshes.moving_count, meshes, refit_meshes(*state_, posed), posed, anchor);
}

const glm::dvec3& RayScene::anchor() const {
    return state_->anchor;
}
bool RayScene::is_flat(int instance) const {
    return state_->meshes->flat[static_cast<std::size_t>(instance)] != 0;
}
const glm::dvec3& RayScene::flat_origin() const {
    return state_->meshes->flat_origin;
}
std::size_t RayScene::degenerate_triangles() const {
    return state_->meshes->degenerate_triangles;
}
std::size_t RayScene::skipped_instances() const {
    return state_->moving.skipped + state_->still.skipped;
}
std::uint64_t RayScene::rays_traced() const {
    return state_->rays_traced.load();
}
std::uint64_t RayScene::invalid_rays() const {
    return state_->invalid_rays.load();
}

}  // namespace aleph
