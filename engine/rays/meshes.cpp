// Builds Embree's structures of every mesh, and groups the scene's instances into objects.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/errors.h"
#include "engine/base/flush_denormals.h"
#include "engine/pose/parts.h"
#include "engine/pose/plan.h"
#include "engine/rays/state.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

void check_mesh(const Mesh& mesh, std::size_t index) {
    const std::string place = fmt::format("mesh {} \"{}\"", index, printable(mesh.name));
    for (const glm::vec3& p : mesh.positions) {
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(p[k]) < max_coordinate)) {
                throw InputError("", place, fmt::format("a position is not finite or too large ({})", p[k]));
            }
        }
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const std::uint32_t highest = std::max({t.x, t.y, t.z});
        if (highest >= mesh.positions.size()) {
            throw InputError("", place,
                             fmt::format("vertex {} of {} used by a triangle", highest, mesh.positions.size()));
        }
    }
}

/// @param places  indices into the node's meshes
std::unique_ptr<TriangleTree> build_tree(const EmbreeDevice& device, const Scene& scene, const std::vector<int>& meshes,
                                         const std::vector<unsigned>& places,
                                         const std::vector<std::unique_ptr<const AlphaCutout>>& cutouts) {
    std::vector<TreeMesh> parts;
    for (const unsigned place : places) {
        const Mesh& mesh = scene.meshes[meshes[place]];
        parts.push_back(
            {{static_cast<int>(place), false, cutouts[meshes[place]].get()}, mesh.positions, mesh.triangles});
    }
    return std::make_unique<TriangleTree>(device, parts, TriangleTree::Kind::still);
}

/// The tree of all flat instances. Null: there are none.
std::unique_ptr<TriangleTree> build_flat_tree(const EmbreeDevice& device, const Scene& scene, const FlatPlan& plan,
                                              const std::vector<std::unique_ptr<const AlphaCutout>>& cutouts) {
    std::vector<std::vector<glm::vec3>> points;
    std::vector<TreeMesh> parts;
    for (std::size_t i = 0; i < plan.flat.size(); ++i) {
        if (plan.flat[i] == 0) continue;
        const auto [node, index] = plan.instances[i];
        const Mesh& mesh = scene.meshes[index];
        const glm::dmat4& world = plan.world[node];
        const glm::dmat3 linear(world);
        const glm::dvec3 place = glm::dvec3(world[3]) - plan.origin;
        std::vector<glm::vec3>& placed = points.emplace_back(mesh.positions.size());
        std::ranges::transform(mesh.positions, placed.begin(),
                               [&](const glm::vec3& p) { return glm::vec3(linear * glm::dvec3(p) + place); });
        parts.push_back(
            {{static_cast<int>(i), orientation_sign(world) < 0.0, cutouts[index].get()}, placed, mesh.triangles});
    }
    if (parts.empty()) return nullptr;
    return std::make_unique<TriangleTree>(device, parts, TriangleTree::Kind::still);
}

/// Up to so many objects that stand still are kept in one top-level scene with the moving ones: sorting them again
/// takes almost no time, while a second top-level scene makes every ray a tenth slower.
constexpr std::size_t max_still_beside_moving = 256;

/// Gathers the scene's meshes into objects, one node after the other.
class ObjectMaker {
  public:
    ObjectMaker(MeshStructures& structures, const Scene& scene, const PosePlan& plan, const FlatPlan& flat)
        : structures_(structures), scene_(scene), plan_(plan), flat_(flat), kinds_(scene.meshes.size()) {
        structures_.flat.tree = build_flat_tree(*structures_.device, scene_, flat_, structures_.cutouts);
        for (const Deformer& deformer : plan.deformers) kinds_[deformer.mesh] = {true, deformer.changes};
        for (std::size_t m = 0; m < kinds_.size(); ++m) kinds_[m].comes_and_goes = !is_always_present(scene.meshes[m]);
    }

    void add_node(int node) {
        const std::vector<int>& meshes = scene_.nodes[node].meshes;
        std::vector<unsigned> rigid;
        for (unsigned place = 0; place < meshes.size(); ++place) {
            const MeshKind& kind = kinds_[meshes[place]];
            if (kind.deforms) {
                add(node, place, kind.changes || kind.comes_and_goes).deforming = deforming(meshes[place], place);
            } else if (kind.comes_and_goes) {
                add(node, place, true).tree = rigid_tree(meshes, {place});
            } else if (const int i = first_instance_ + static_cast<int>(place);
                       flat_.flat[i] == 0 && flat_.shown[i] != 0) {
                rigid.push_back(place);
            }
        }
        if (!rigid.empty()) add(node, rigid.front(), false).tree = rigid_tree(meshes, rigid);
        first_instance_ += static_cast<int>(meshes.size());
    }

    void finish() {
        structures_.moving_count = structures_.objects.size();
        structures_.objects.insert(structures_.objects.end(), still_.begin(), still_.end());
        structures_.first_layer_count =
            still_.size() > max_still_beside_moving ? structures_.moving_count : structures_.objects.size();
    }

  private:
    struct MeshKind {
        bool deforms = false, changes = false;
        bool comes_and_goes = false;  ///< or is never there: it must not share an object with others either
    };

    MeshStructures::Object& add(int node, unsigned place, bool changes) {
        const bool moves = changes || plan_.moving[node] != 0;
        std::vector<MeshStructures::Object>& objects = moves ? structures_.objects : still_;
        objects.push_back({node, first_instance_, first_instance_ + static_cast<int>(place)});
        return objects.back();
    }

    int deforming(int mesh, unsigned place) {
        const auto [found, is_new] =
            deforming_.try_emplace({mesh, place}, static_cast<int>(structures_.deforming.size()));
        if (is_new) {
            const Mesh& of = scene_.meshes[mesh];
            structures_.deforming.push_back({.mesh = mesh,
                                             .place = static_cast<int>(place),
                                             .changes = kinds_[mesh].changes,
                                             .vertex_count = of.positions.size(),
                                             .triangles = of.triangles,
                                             .cutout = structures_.cutouts[mesh].get()});
        }
        return found->second;
    }

    const TriangleTree* rigid_tree(const std::vector<int>& meshes, const std::vector<unsigned>& places) {
        const TriangleTree*& built = rigid_[{meshes, places}];
        if (built == nullptr) {
            structures_.trees.push_back(build_tree(*structures_.device, scene_, meshes, places, structures_.cutouts));
            built = structures_.trees.back().get();
        }
        return built;
    }

    MeshStructures& structures_;
    const Scene& scene_;
    const PosePlan& plan_;
    const FlatPlan& flat_;
    std::vector<MeshKind> kinds_;  ///< per mesh of the scene
    int first_instance_ = 0;
    std::vector<MeshStructures::Object> still_;
    std::map<std::pair<int, unsigned>, int> deforming_;
    std::map<std::pair<std::vector<int>, std::vector<unsigned>>, const TriangleTree*> rigid_;
};

}  // namespace

MeshStructures::MeshStructures(const Scene& scene, const PosePlan& plan, std::unique_ptr<EmbreeDevice> embree,
                               bool flatten)
    : device(std::move(embree)) {
    const FlushDenormals flush;
    if (rtcGetDeviceProperty(device->handle(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) packet_width = 8;
    if (rtcGetDeviceProperty(device->handle(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) packet_width = 16;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) check_mesh(scene.meshes[i], i);
    cutouts.resize(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!has_cutout(scene, scene.meshes[i])) continue;
        cutouts[i] = std::make_unique<const AlphaCutout>(make_alpha_cutout(scene, scene.meshes[i]));
        any_cutout = true;
        any_blended = any_blended || cutouts[i]->blended;
        any_plain = any_plain || cutouts[i]->plain;
    }
    for (const Mesh& mesh : scene.meshes) bounds.push_back(find_bounds(mesh.positions, mesh.triangles));
    const FlatPlan flat_plan = make_flat_plan(scene, plan, flatten);
    flat.instances = flat_plan.flat;
    flat.origin = flat_plan.origin;
    flat.count = static_cast<std::size_t>(std::ranges::count(flat.instances, 1));
    ObjectMaker maker(*this, scene, plan, flat_plan);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) maker.add_node(static_cast<int>(n));
    maker.finish();
}

}  // namespace aleph
