// Builds Embree's structures of every mesh, and groups the scene's instances into objects.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/errors.h"
#include "engine/base/flush_denormals.h"
#include "engine/pose/plan.h"
#include "engine/rays/state.h"

namespace aleph {
namespace {

std::size_t count_degenerate(const Mesh& mesh) {
    std::size_t count = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const glm::dvec3 n = glm::cross(b - a, c - a);
        if (!(glm::dot(n, n) > 0.0)) ++count;
    }
    return count;
}

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

/// @param places  indices into the node's meshes; they become Embree's geometry numbers
EmbreeScene build_mesh_scene(const EmbreeDevice& device, const Scene& scene, const std::vector<int>& meshes,
                             const std::vector<unsigned>& places,
                             const std::vector<std::unique_ptr<const AlphaCutout>>& cutouts) {
    EmbreeScene built = device.make_scene(RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH);
    for (const unsigned place : places) {
        const Mesh& mesh = scene.meshes[meshes[place]];
        if (mesh.triangles.empty()) continue;
        const TriangleGeometry made =
            make_triangle_geometry(device, mesh.positions.size(), mesh.triangles, cutouts[meshes[place]].get());
        std::ranges::copy(mesh.positions, made.points.begin());
        rtcCommitGeometry(made.geometry.get());
        rtcAttachGeometryByID(built.get(), made.geometry.get(), place);
    }
    rtcCommitScene(built.get());
    device.check();
    return built;
}

/// Up to so many objects that stand still are kept in one top-level scene with the moving ones: sorting them again
/// takes almost no time, while a second top-level scene makes every ray a tenth slower.
constexpr std::size_t max_still_beside_moving = 256;

/// How each mesh of the scene is handled.
struct MeshKinds {
    MeshKinds(const Scene& scene, const PosePlan& plan)
        : deforms(scene.meshes.size(), 0), changes(scene.meshes.size(), 0), comes_and_goes(scene.meshes.size(), 0) {
        for (const Deformer& deformer : plan.deformers) {
            deforms[deformer.mesh] = 1;
            changes[deformer.mesh] = deformer.changes;
        }
        // A mesh that is never present must not share an object with others either.
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            comes_and_goes[m] = scene.meshes[m].present != Track<double>(1.0);
    }
    std::vector<std::uint8_t> deforms, changes, comes_and_goes;
};

/// Gathers the scene's meshes into objects, one node after the other.
class ObjectMaker {
  public:
    ObjectMaker(MeshStructures& structures, const Scene& scene, const PosePlan& plan)
        : structures_(structures), scene_(scene), plan_(plan), kinds_(scene, plan_) {}

    void add_node(int node) {
        const std::vector<int>& meshes = scene_.nodes[node].meshes;
        std::vector<unsigned> rigid;
        for (unsigned place = 0; place < meshes.size(); ++place) {
            const auto mesh = static_cast<std::size_t>(meshes[place]);
            if (kinds_.deforms[mesh] != 0) {
                add(node, place, kinds_.changes[mesh] != 0 || kinds_.comes_and_goes[mesh] != 0).deforming =
                    deforming(meshes[place], place);
            } else if (kinds_.comes_and_goes[mesh] != 0) {
                add(node, place, true).mesh_scene = rigid_scene(meshes, {place});
            } else {
                rigid.push_back(place);
            }
        }
        if (!rigid.empty()) add(node, rigid.front(), false).mesh_scene = rigid_scene(meshes, rigid);
        first_instance_ += static_cast<int>(meshes.size());
    }

    void finish() {
        structures_.moving_count = structures_.objects.size();
        structures_.objects.insert(structures_.objects.end(), still_.begin(), still_.end());
        structures_.first_layer_count =
            still_.size() > max_still_beside_moving ? structures_.moving_count : structures_.objects.size();
    }

  private:
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
            const auto m = static_cast<std::size_t>(mesh);
            structures_.deforming.emplace_back(scene_.meshes[m], mesh, place, kinds_.changes[m] != 0,
                                               structures_.cutouts[m].get());
        }
        return found->second;
    }

    RTCScene rigid_scene(const std::vector<int>& meshes, const std::vector<unsigned>& places) {
        RTCScene& built = rigid_[{meshes, places}];
        if (built == nullptr) {
            structures_.mesh_scenes.push_back(
                build_mesh_scene(*structures_.device, scene_, meshes, places, structures_.cutouts));
            built = structures_.mesh_scenes.back().get();
        }
        return built;
    }

    MeshStructures& structures_;
    const Scene& scene_;
    const PosePlan& plan_;
    MeshKinds kinds_;
    int first_instance_ = 0;
    std::vector<MeshStructures::Object> still_;
    std::map<std::pair<int, unsigned>, int> deforming_;
    std::map<std::pair<std::vector<int>, std::vector<unsigned>>, RTCScene> rigid_;
};

}  // namespace

MeshStructures::MeshStructures(const Scene& scene, const PosePlan& plan, std::unique_ptr<EmbreeDevice> embree)
    : device(std::move(embree)) {
    const FlushDenormals flush;
    if (rtcGetDeviceProperty(device->handle(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) packet_width = 8;
    if (rtcGetDeviceProperty(device->handle(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) packet_width = 16;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        check_mesh(scene.meshes[i], i);
        degenerate_triangles += count_degenerate(scene.meshes[i]);
    }
    cutouts.resize(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!has_cutout(scene, scene.meshes[i])) continue;
        cutouts[i] = std::make_unique<const AlphaCutout>(make_alpha_cutout(scene, scene.meshes[i]));
        any_cutout = true;
        any_blended = any_blended || cutouts[i]->blended;
    }
    ObjectMaker maker(*this, scene, plan);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) maker.add_node(static_cast<int>(n));
    maker.finish();
}

}  // namespace aleph
