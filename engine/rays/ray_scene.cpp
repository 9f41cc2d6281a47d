#include "engine/rays/ray_scene.h"

#include <algorithm>

#include "engine/base/flush_denormals.h"
#include "engine/rays/state.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

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

/// Places the first objects of a layer.
/// @return how many changed
std::size_t place_objects(ObjectLayer& layer, std::span<const MeshStructures::Object> objects,
                          const RayScene::State& state, const std::vector<RefitMesh::Change>& changes,
                          const ScenePose& posed, const glm::dvec3& anchor) {
    std::size_t touched = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const MeshStructures::Object& object = objects[i];
        const bool deforms = object.deforming != no_index;
        const RefitMesh::Change change = deforms ? changes[object.deforming] : RefitMesh::Change::none;
        const TriangleTree* const tree = deforms ? state.refits[object.deforming]->tree() : object.tree;
        const bool usable = change != RefitMesh::Change::unusable && tree != nullptr;
        const ObjectState now{usable && posed.shown[object.instance] != 0, change == RefitMesh::Change::moved};
        touched += layer.place(i, {tree, object.first_instance}, posed.world[object.node], anchor, now);
    }
    if (touched > 0) layer.commit();
    return touched;
}

}  // namespace

RayScene::State::State(std::shared_ptr<const MeshStructures> shared) : meshes(std::move(shared)) {
    for (const DeformingMesh& mesh : meshes->deforming)
        refits.push_back(std::make_unique<RefitMesh>(*meshes->device, mesh));
    const std::size_t first = meshes->first_layer_count;
    moving = std::make_unique<ObjectLayer>(*meshes->device, first);
    still = std::make_unique<ObjectLayer>(*meshes->device, meshes->objects.size() - first);
}

bool is_traceable(const glm::dmat4& world) {
    const auto fits = [&](int column) { return is_within(glm::dvec3(world[column]), max_coordinate); };
    return has_full_rank(world) && fits(0) && fits(1) && fits(2) && fits(3);
}

bool are_traceable(const std::vector<glm::dvec3>& positions) {
    return std::ranges::all_of(positions, [](const glm::dvec3& p) { return is_within(p, max_coordinate); });
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
    State& state = *state_;
    note_alpha(state, posed);
    const std::vector<RefitMesh::Change> changes = refit_meshes(state, posed);
    const std::span<const MeshStructures::Object> objects(state.meshes->objects);
    if (state.placed && anchor == state.anchor)
        return place_objects(*state.moving, objects.first(state.meshes->moving_count), state, changes, posed, anchor);
    const std::size_t first = state.moving->size();
    std::size_t touched = place_objects(*state.moving, objects.first(first), state, changes, posed, anchor);
    touched += place_objects(*state.still, objects.subspan(first), state, changes, posed, anchor);
    state.anchor = anchor;
    state.flat_shift = anchor - state.meshes->flat.origin;
    state.placed = true;
    return touched + state.meshes->flat.count;
}

const glm::dvec3& RayScene::anchor() const {
    return state_->anchor;
}
bool RayScene::is_flat(int instance) const {
    return state_->meshes->flat.instances[static_cast<std::size_t>(instance)] != 0;
}
const glm::dvec3& RayScene::flat_origin() const {
    return state_->meshes->flat.origin;
}
const MeshBounds& RayScene::bounds(int mesh) const {
    return state_->meshes->bounds[static_cast<std::size_t>(mesh)];
}
std::uint64_t RayScene::rays_traced() const {
    return state_->rays_traced.load();
}
std::uint64_t RayScene::invalid_rays() const {
    return state_->invalid_rays.load();
}

}  // namespace aleph
