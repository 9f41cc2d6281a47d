#pragma once
// A scene at a time: every transform composed in double, every track evaluated.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/base/color.h"
#include "engine/scene/scene.h"

namespace aleph {

/// One mesh under one node. The list is the same at every time, so an index means the same object over the whole shot.
struct Instance {
    int node = no_index;
    int mesh = no_index;
    bool operator==(const Instance&) const = default;
};

struct MaterialValues {
    Rgb base_color{1.0f};
    float alpha = 1.0f;
    Rgb emission{0.0f};  ///< radiance, strength included
    GlossOf<float, Rgb> gloss;
    GlassOf<float, Rgb> glass;
    LayersOf<float, Rgb> layers;
    bool operator==(const MaterialValues&) const = default;
};

struct LightValues {
    Light::Kind kind = Light::Kind::point;
    int node = no_index;
    glm::dvec3 position{0.0};              ///< world, m
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< world, unit, the way the light travels
    Rgb intensity{1.0f};                   ///< candela or lux, colour included
    double range = 0.0;
    double inner_cone = 0.0, outer_cone = 0.0;  ///< spot, radians
    bool operator==(const LightValues&) const = default;
};

struct CameraValues {
    int node = no_index;
    bool orthographic = false;
    glm::dvec3 position{0.0};  ///< world, m
    glm::dmat3 axes{1.0};      ///< columns right, up, back in world; orthonormal (the node's scale taken out)
    double fov = 0.785;        ///< vertical, radians
    double half_height = 1.0;  ///< orthographic, m
    double shift_x = 0.0, shift_y = 0.0;  ///< in heights of the picture
    double near_plane = 1e-4;
    double aperture = 0.0, focus_distance = 1.0;
    bool operator==(const CameraValues&) const = default;
};

/// Replaces the arrays of a deforming mesh at a time. In double, because motion is a difference of projections.
struct PosedMesh {
    std::vector<glm::dvec3> positions;  ///< m, object space, per vertex; empty: the mesh is rigid
    std::vector<glm::vec3> normals;     ///< per vertex; empty: flat
    std::vector<glm::dvec3> control;    ///< of a cage's mesh: control points of its LimitSurface
    bool mirrored = false;              ///< by its skin: triangles and normals face inwards
    bool operator==(const PosedMesh&) const = default;
};

/// The scene at a time.
struct ScenePose {
    double seconds = 0.0;
    std::vector<glm::dmat4> world;      ///< per node, object to world
    std::vector<std::uint8_t> visible;  ///< per node, ancestors included
    std::vector<Instance> instances;    ///< list_instances(scene)
    std::vector<std::uint8_t> shown;    ///< per instance: its node is visible and its mesh present
    std::vector<PosedMesh> meshes;      ///< per mesh of the scene
    std::vector<MaterialValues> materials;
    std::vector<LightValues> lights;       ///< visible nodes that hold a light, in node order
    std::vector<CameraValues> cameras;     ///< nodes that hold a camera, in node order
    Rgb environment{0.0f};                 ///< radiance, or factor on Environment::image
    glm::dmat3 environment_rotation{1.0};  ///< picture to world
};

/// Every (node, mesh) pair in node order, visible or not.
std::vector<Instance> list_instances(const Scene& scene);

/// Per instance: false where it is hidden at all times.
std::vector<std::uint8_t> list_ever_shown(const Scene& scene);

/// Poses the scene at a time, s. The result depends on the arguments alone. Any depth of the hierarchy is fine.
ScenePose pose(const Scene& scene, double seconds);

/// The scene's frames: Film::range where given, else the span of all keys, rounded inwards to whole frames.
FrameRange frame_range(const Scene& scene);

/// Gives a film another frame rate. Its range, its cuts and the keys of its cameras keep their times: a shot begins
/// with the first frame that is not before its time.
void change_frame_rate(Film& film, const FrameRate& rate);

/// The cameras of a scene by name.
class CameraNames {
  public:
    /// Keeps a reference to the scene.
    explicit CameraNames(const Scene& scene);

    /// Index into ScenePose::cameras (the same at every time) by node or camera name; an empty name takes the scene's
    /// choice (the first of its camera keys), then the first.
    /// @throws InputError if there is none of that name, listing those that exist, or no camera at all
    int find(const std::string& name) const;

  private:
    const Scene& scene_;
    int count_ = 0;
    std::unordered_map<std::string, int> nodes_, cameras_;  ///< the first of each name
};

/// The camera that looks from a frame on.
struct CameraShot {
    std::int64_t first = 0;  ///< frame; the first shot holds before it too
    int camera = 0;          ///< index into ScenePose::cameras

    bool operator==(const CameraShot&) const = default;
};

/// The scene's camera keys, without those that change nothing; one shot if a camera is named or there are no keys.
/// @throws InputError as CameraNames::find
std::vector<CameraShot> list_camera_shots(const Scene& scene, const std::string& name);

/// The camera of the shot that a frame belongs to.
int camera_at(const std::vector<CameraShot>& shots, std::int64_t frame);

/// Per node: there is a mesh, a light or a joint at or below it.
std::vector<bool> nodes_with_content(const Scene& scene);

/// True if anything that a ScenePose holds can differ between two times, apart from cameras.
bool is_world_animated(const Scene& scene);

}  // namespace aleph
