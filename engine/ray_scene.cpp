#include "engine/ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/errors.h"
#include "engine/base/flush_denormals.h"
#include "engine/ray_scene_state.h"
#include "engine/transforms.h"

namespace aleph {

namespace {

/// Embree drops geometry beyond this without a word (HARD_CASES RC-08); so we refuse it with one.
constexpr float largest_coordinate = 1.844e18f;

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
            if (!(std::abs(p[k]) < largest_coordinate)) {
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

RTCScene build_mesh_scene(RTCDevice device, const Scene& scene, const std::vector<int>& meshes) {
    RTCScene built = rtcNewScene(device);
    rtcSetSceneFlags(built, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(built, RTC_BUILD_QUALITY_HIGH);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(meshes[i])];
        if (mesh.triangles.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree allocates, which brings the padding that its wide loads need (HARD_CASES RC-14).
        auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
        auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
        std::copy(mesh.positions.begin(), mesh.positions.end(), points);
        std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(built, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(built);
    return built;
}

}  // namespace

MeshStructures::MeshStructures(const Scene& scene) {
    const FlushDenormals flush;
    device = rtcNewDevice(nullptr);
    if (device == nullptr) throw std::runtime_error("Embree found no way to start on this machine");
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) packet_width = 16;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        check_mesh(scene.meshes[i], i);
        degenerate_triangles += count_degenerate(scene.meshes[i]);
    }
    std::map<std::vector<int>, RTCScene> built;
    int first_instance = 0;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const std::vector<int>& meshes = scene.nodes[n].meshes;
        if (meshes.empty()) continue;
        auto found = built.find(meshes);
        if (found == built.end()) {
            found = built.emplace(meshes, build_mesh_scene(device, scene, meshes)).first;
            mesh_scenes.push_back(found->second);
        }
        objects.push_back({static_cast<int>(n), first_instance, found->second});
        first_instance += static_cast<int>(meshes.size());
    }
}

MeshStructures::~MeshStructures() {
    for (RTCScene mesh_scene : mesh_scenes) rtcReleaseScene(mesh_scene);
    if (device != nullptr) rtcReleaseDevice(device);
}

RayScene::State::State(std::shared_ptr<const MeshStructures> shared) : meshes(std::move(shared)) {
    top = rtcNewScene(meshes->device);
    rtcSetSceneFlags(top, RTC_SCENE_FLAG_ROBUST);
    placements.resize(meshes->objects.size());
    for (std::size_t i = 0; i < placements.size(); ++i) {
        RTCGeometry geometry = rtcNewGeometry(meshes->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, meshes->objects[i].mesh_scene);
        rtcSetGeometryTimeStepCount(geometry, 1);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(top, geometry, static_cast<unsigned>(i));
        rtcDisableGeometry(geometry);
        placements[i].geometry = geometry;
    }
    rtcCommitScene(top);
}

RayScene::State::~State() {
    for (const Placement& placement : placements) rtcReleaseGeometry(placement.geometry);
    if (top != nullptr) rtcReleaseScene(top);
}

bool is_traceable(const glm::dmat4& world, const glm::dvec3& anchor) {
    if (!has_full_rank(world)) return false;
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(world));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(inverse[column][row]));
    }
    const glm::dvec3 moved = glm::abs(inverse * (glm::dvec3(world[3]) - anchor));
    return 3.0 * largest * largest_ray_component + std::max({moved.x, moved.y, moved.z}) < largest_coordinate;
}

RayScene::RayScene(const Scene& scene) : state_(new State(std::make_shared<MeshStructures>(scene))) {}
RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

RayScene RayScene::share_meshes() const {
    return RayScene(std::make_unique<State>(state_->meshes));
}

std::size_t RayScene::update(const SceneFrame& frame, const glm::dvec3& anchor) {
    const FlushDenormals flush;
    State& state = *state_;
    std::size_t touched = 0;
    state.skipped_instances = 0;
    for (std::size_t i = 0; i < state.placements.size(); ++i) {
        Placement& placement = state.placements[i];
        const std::size_t node = static_cast<std::size_t>(state.meshes->objects[i].node);
        const glm::dmat4& world = frame.world[node];
        bool enabled = frame.visible[node] != 0;
        if (enabled && !is_traceable(world, anchor)) {
            enabled = false;
            ++state.skipped_instances;
        }
        std::array<float, 12> transform{};  // column by column: RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                const double value = column < 3 ? world[column][row] : world[3][row] - anchor[row];
                transform[static_cast<std::size_t>(column * 3 + row)] = static_cast<float>(value);
            }
        }
        if (enabled == placement.enabled && (!enabled || transform == placement.transform)) continue;
        ++touched;
        if (enabled) {
            rtcSetGeometryTransform(placement.geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
            rtcCommitGeometry(placement.geometry);
        }
        if (enabled && !placement.enabled) rtcEnableGeometry(placement.geometry);
        if (!enabled && placement.enabled) rtcDisableGeometry(placement.geometry);
        placement.enabled = enabled;
        placement.transform = transform;
    }
    if (touched > 0) rtcCommitScene(state.top);
    state.anchor = anchor;
    return touched;
}

const glm::dvec3& RayScene::anchor() const {
    return state_->anchor;
}
std::size_t RayScene::degenerate_triangles() const {
    return state_->meshes->degenerate_triangles;
}
std::size_t RayScene::skipped_instances() const {
    return state_->skipped_instances;
}
std::uint64_t RayScene::rays_traced() const {
    return state_->rays_traced.load();
}
std::uint64_t RayScene::invalid_rays() const {
    return state_->invalid_rays.load();
}

}  // namespace aleph
