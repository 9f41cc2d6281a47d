#include "engine/rays/object_layer.h"

#include <limits>

#include "engine/rays/traversal.h"

namespace aleph {
namespace {

const ObjectLayer& layer_of(void* user_data) {
    return *static_cast<const ObjectLayer*>(user_data);
}

void write_object_bounds(const RTCBoundsFunctionArguments* arguments) {
    const ObjectLayer& layer = layer_of(arguments->geometryUserPtr);
    const Placement& placement = layer.placement(arguments->primID);
    constexpr float none = std::numeric_limits<float>::infinity();  // Embree leaves empty boxes out
    *arguments->bounds_o = placement.enabled ? layer.extent().enlarge(placement.bounds.low, placement.bounds.high)
                                             : RTCBounds{none, none, none, 0.0f, -none, -none, -none, 0.0f};
}

void trace_placement(const Placement& placement, const Traversal& outer, RayLane& lane) {
    Traversal traversal(outer, lane);
    traversal.first_instance = placement.object.first_instance;
    trace_triangles(*placement.object.tree, placement.to_tree * (lane.origin - placement.place),
                    placement.to_tree * lane.direction, traversal);
}

void intersect_objects(const RTCIntersectFunctionNArguments* arguments) {
    const Traversal& traversal = *reinterpret_cast<const Traversal*>(arguments->context);
    const Placement& placement = layer_of(arguments->geometryUserPtr).placement(arguments->primID);
    RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        RayLane& lane = traversal.lanes[i];
        trace_placement(placement, traversal, lane);
        RTCRayN_tfar(rays, arguments->N, i) = embree_far(lane, lane.entry);
    }
}

void occlude_objects(const RTCOccludedFunctionNArguments* arguments) {
    const Traversal& traversal = *reinterpret_cast<const Traversal*>(arguments->context);
    const Placement& placement = layer_of(arguments->geometryUserPtr).placement(arguments->primID);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        RayLane& lane = traversal.lanes[i];
        trace_placement(placement, traversal, lane);
        if (lane.blocked) RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
    }
}

}  // namespace

ObjectLayer::ObjectLayer(const EmbreeDevice& device, std::size_t count) : device_(device), placements_(count) {
    scene_ = device.make_scene(RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM);
    geometry_ = device.make_geometry();
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), static_cast<unsigned>(count));
    rtcSetGeometryUserData(geometry_.get(), this);
    rtcSetGeometryBoundsFunction(geometry_.get(), write_object_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry_.get(), intersect_objects);
    rtcSetGeometryOccludedFunction(geometry_.get(), occlude_objects);
    rtcAttachGeometryByID(scene_.get(), geometry_.get(), 0);
    commit();
}

bool ObjectLayer::place(std::size_t index, const PlacedTree& object, const glm::dmat4& world, const glm::dvec3& anchor,
                        const ObjectState& state) {
    Placement& placement = placements_[index];
    const glm::dvec3 place = glm::dvec3(world[3]) - anchor;
    Bounds bounds;
    bool enabled = state.shown && is_traceable(world);
    if (enabled && !object.tree->bounds().empty()) {
        glm::dmat4 placed = world;
        placed[3] = glm::dvec4(place, 1.0);
        object.tree->bounds().add_corners_to(bounds, placed);
        enabled = is_within(bounds.low, max_coordinate) && is_within(bounds.high, max_coordinate);
    }
    const bool same =
        !state.changed && world == placement.world && place == placement.place && placement.object == object;
    if (enabled == placement.enabled && (!enabled || same)) return false;
    enabled_ = enabled_ + (enabled ? 1 : 0) - (placement.enabled ? 1 : 0);
    placement.enabled = enabled;
    if (!enabled) return true;
    placement.object = object;
    placement.world = world;
    placement.to_tree = glm::inverse(glm::dmat3(world));
    placement.place = place;
    placement.bounds = bounds;
    return true;
}

void ObjectLayer::commit() {
    Bounds bounds;
    for (const Placement& placement : placements_) {
        if (!placement.enabled || placement.bounds.empty()) continue;
        bounds.add(placement.bounds.low);
        bounds.add(placement.bounds.high);
    }
    extent_ = TreeExtent(bounds);
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    device_.check();
}

}  // namespace aleph
