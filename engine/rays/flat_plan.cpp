#include "engine/rays/flat_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/bounds.h"
#include "engine/pose/parts.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

/// m. So far from the origin a float resolves 2 um: four times less than near the camera, relative to the anchor.
constexpr double max_reach = 32.0;
/// Rounding then changes a size by at most 6e-5, and rays start at most a thousandth of the size above the surface.
constexpr double max_reach_in_sizes = 1024.0;
/// m. Differences of such coordinates are far below max_coordinate.
constexpr double max_place = 1e15;
constexpr std::size_t free_triangles = std::size_t{1} << 18;

/// An instance that could be in the flat tree.
struct Candidate {
    std::size_t instance;
    Bounds bounds;  ///< world, m
    double own;     ///< m: largest distance of its points from the object's own origin, along an axis
};

std::vector<std::uint8_t> find_still_meshes(const Scene& scene, const PosePlan& plan) {
    std::vector<std::uint8_t> still(scene.meshes.size());
    for (std::size_t m = 0; m < still.size(); ++m)
        still[m] = !scene.meshes[m].triangles.empty() && is_always_present(scene.meshes[m]);
    for (const Deformer& deformer : plan.deformers) still[deformer.mesh] = 0;
    return still;
}

/// m: the largest distance of a point in the box from a place, along an axis.
double reach_from(const glm::dvec3& place, const Bounds& bounds) {
    return std::max(largest_element(bounds.low - place), largest_element(bounds.high - place));
}

Candidate make_candidate(std::size_t instance, const Bounds& mesh, const glm::dmat4& world) {
    Candidate candidate{instance, {}, 0.0};
    mesh.add_corners_to(candidate.bounds, world);
    const glm::dvec3 place(world[3]);
    candidate.own = reach_from(place, candidate.bounds);
    return candidate;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median of the instances' centres: what lies far off does not move it. Rounded to a power of two, so that simple
/// coordinates remain exact.
glm::dvec3 choose_origin(const std::vector<Candidate>& candidates) {
    glm::dvec3 origin(0.0);
    std::vector<double> values(candidates.size());
    const auto median_of = [&](const auto& value) {
        std::ranges::transform(candidates, values.begin(), value);
        return median(values);
    };
    for (int axis = 0; axis < 3; ++axis)
        origin[axis] = median_of([&](const Candidate& c) { return 0.5 * (c.bounds.low[axis] + c.bounds.high[axis]); });
    const double reach = median_of([&](const Candidate& c) { return reach_from(origin, c.bounds); });
    if (!(reach > 0.0) || !std::isfinite(reach)) return origin;
    const double cell = std::exp2(std::floor(std::log2(reach)) - 2.0);
    return glm::round(origin / cell) * cell;
}

/// True where coordinates relative to the origin are precise enough: its own already are about as large, or it lies
/// near the origin.
bool fits(const Candidate& candidate, const glm::dvec3& origin) {
    const double reach = reach_from(origin, candidate.bounds);
    const double size = largest_element(candidate.bounds.high - candidate.bounds.low);
    return reach <= std::max(max_reach, 2.0 * candidate.own) && reach <= max_reach_in_sizes * size;
}

/// Per mesh, whether its candidates may be copied. Meshes with the fewest additional triangles come first.
std::vector<std::uint8_t> choose_copied(const Scene& scene, const FlatPlan& plan,
                                        const std::vector<Candidate>& candidates) {
    std::vector<std::size_t> copies(scene.meshes.size(), 0), others(scene.meshes.size(), 0);
    for (std::size_t i = 0; i < plan.instances.size(); ++i) others[plan.instances[i].mesh] += plan.shown[i];
    for (const Candidate& candidate : candidates) {
        const int mesh = plan.instances[candidate.instance].mesh;
        ++copies[mesh];
        --others[mesh];
    }
    std::size_t left = free_triangles;
    std::vector<std::size_t> added(scene.meshes.size(), 0);
    for (std::size_t m = 0; m < added.size(); ++m) {
        if (copies[m] == 0) continue;
        const std::size_t triangles = scene.meshes[m].triangles.size();
        left += triangles;
        added[m] = triangles * (copies[m] - (others[m] == 0 ? 1 : 0));
    }
    std::vector<std::size_t> order(added.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t m) { return added[m]; });
    std::vector<std::uint8_t> copied(added.size(), 0);
    for (const std::size_t m : order) {
        if (added[m] > left) break;
        left -= added[m];
        copied[m] = 1;
    }
    return copied;
}

std::vector<Candidate> find_candidates(const Scene& scene, const PosePlan& poses, const FlatPlan& plan) {
    const std::vector<std::uint8_t> still = find_still_meshes(scene, poses);
    std::vector<Bounds> bounds(scene.meshes.size());
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < plan.instances.size(); ++i) {
        const Instance& instance = plan.instances[i];
        const glm::dmat4& world = plan.world[instance.node];
        if (poses.moving[instance.node] != 0 || still[instance.mesh] == 0 || plan.shown[i] == 0 ||
            !has_full_rank(world))
            continue;
        Bounds& box = bounds[instance.mesh];
        if (box.empty())
            for (const glm::vec3& p : scene.meshes[instance.mesh].positions) box.add(glm::dvec3(p));
        const Candidate candidate = make_candidate(i, box, world);
        if (is_within(glm::dvec3(world[3]), max_place) && is_within(candidate.bounds.low, max_place) &&
            is_within(candidate.bounds.high, max_place))
            candidates.push_back(candidate);
    }
    return candidates;
}

}  // namespace

FlatPlan make_flat_plan(const Scene& scene, const PosePlan& plan, bool flatten) {
    FlatPlan made;
    made.instances = list_instances(scene);
    made.shown.resize(made.instances.size(), 1);
    made.flat.resize(made.instances.size(), 0);
    if (!flatten) return made;
    ScenePose posed;
    posed.world.resize(scene.nodes.size());
    posed.visible.resize(scene.nodes.size());
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (plan.moving[n] == 0) place_node(scene, static_cast<int>(n), 0.0, posed);
    for (std::size_t i = 0; i < made.instances.size(); ++i) {
        const int node = made.instances[i].node;
        made.shown[i] = plan.moving[node] != 0 || posed.visible[node] != 0;
    }
    made.world = std::move(posed.world);
    std::vector<Candidate> candidates = find_candidates(scene, plan, made);
    if (candidates.empty()) return made;
    made.origin = choose_origin(candidates);
    std::erase_if(candidates, [&](const Candidate& candidate) { return !fits(candidate, made.origin); });
    const std::vector<std::uint8_t> copied = choose_copied(scene, made, candidates);
    for (const Candidate& candidate : candidates)
        made.flat[candidate.instance] = copied[made.instances[candidate.instance].mesh];
    return made;
}

}  // namespace aleph
