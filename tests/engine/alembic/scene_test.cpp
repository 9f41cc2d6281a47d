// Archives as scenes: load_scene and pose against the truth beside them.
#include <glm/gtc/type_ptr.hpp>

#include "engine/alembic/camera.h"
#include "engine/pose/pose.h"
#include "engine/scene/operations.h"
#include "engine/scene/points.h"
#include "tests/engine/alembic/fixture.h"

namespace aleph {
namespace {

const Node& node_at(const Scene& scene, const std::string& path) {
    const int node = find_node(scene, path);
    if (node == no_index) throw std::out_of_range("no node " + path);
    return scene.nodes[node];
}

/// 1e-9 relative, element by element. The truth has rounded sines of right angles where the reader may have 0.
void expect_matrix(const glm::dmat4& m, const json& truth, const std::string& where) {
    for (int i = 0; i < 16; ++i) {
        const double expected = truth[i];
        EXPECT_NEAR(glm::value_ptr(m)[i], expected, 1e-9 * std::abs(expected) + 1e-14) << where << " element " << i;
    }
}

class AlembicScene : public AlembicTruth {
  protected:
    /// check(t, frame, object) of the truth's query times and objects.
    template <class Check>
    void check_at_every_time(const Check& check) const {
        for (std::size_t t = 0; t < truth["query_times"].size(); ++t) {
            const ScenePose frame = pose(scene, truth["query_times"][t]);
            for (const json& object : truth["objects"]) check(t, frame, object);
        }
    }

    const Scene scene = load(GetParam());
};

TEST_P(AlembicScene, WorldTransformsAtEveryQueryTime) {
    int compared = 0;
    check_at_every_time([&](std::size_t t, const ScenePose& frame, const json& object) {
        const bool xform = object.contains("xform");
        if (!xform && !object.contains("world_lerp_ops_at")) return;
        const std::string path = object["path"];
        const int node = find_node(scene, path);
        ASSERT_NE(node, no_index) << path;
        const json& world = xform ? object["xform"]["at"][t]["world_lerp_ops"] : object["world_lerp_ops_at"][t];
        expect_matrix(frame.world[node], world, fmt::format("{} at time {}", path, t));
        ++compared;
    });
    EXPECT_GE(compared, GetParam() == "property_zoo" ? 0 : 4);
}

/// Operations, channels of every sample, and local transforms between the samples.
TEST_P(AlembicScene, OperationsAndLocalTransforms) {
    using Kind = OperationStack::Kind;
    const std::map<std::string, Kind> kinds{{"translate", Kind::translate}, {"scale", Kind::scale},
                                            {"matrix", Kind::matrix},       {"rotate", Kind::rotate},
                                            {"rotateX", Kind::rotate_x},    {"rotateY", Kind::rotate_y},
                                            {"rotateZ", Kind::rotate_z}};
    for (const json& object : truth["objects"]) {
        if (!object.contains("xform")) continue;
        const std::string path = object["path"];
        const json& xform = object["xform"];
        const Node& node = node_at(scene, path);
        std::vector<Kind> operations;
        for (const json& operation : xform["ops"]) operations.push_back(kinds.at(operation["type"]));
        const OperationStack stack = node.transform.operations.value_or(OperationStack{});
        EXPECT_EQ(stack.operations, operations) << path;
        for (const json& sample : xform["samples"]) {
            expect_matrix(evaluate(stack, sample["time"]), sample["matrix"], path + " sample");
            EXPECT_EQ(evaluate(node.inherits, sample["time"]) != 0.0, sample["inherits"].get<bool>()) << path;
        }
        for (const json& at : xform["at"]) {
            expect_matrix(evaluate(stack, at["time"]), at["local_lerp_ops"], path + " between");
            EXPECT_EQ(evaluate(node.inherits, at["time"]) != 0.0, at["inherits_at_floor"].get<bool>()) << path;
        }
    }
}

/// Every object but face sets and materials is a node at its path, instances expanded; and there is nothing else.
TEST_P(AlembicScene, PathsOfNodes) {
    std::set<std::string> expected, found;
    for (const json& object : truth["objects"]) {
        const std::string schema = object["schema"], path = object["path"];
        if (path != "/" && schema != "AbcGeom_FaceSet_v1" && schema != "AbcMaterial_Material_v1") expected.insert(path);
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].include == 0) found.insert(path_of(scene, static_cast<int>(i)));
    EXPECT_EQ(found, expected);
}

TEST_P(AlembicScene, VisibilityAtEveryQueryTime) {
    check_at_every_time([&](std::size_t t, const ScenePose& frame, const json& object) {
        const int node = find_node(scene, object["path"]);
        if (node == no_index) return;
        const bool hidden = object.contains("hidden_at") && object["hidden_at"][t].get<bool>();
        EXPECT_EQ(frame.visible[node], !hidden) << object["path"] << " " << t;
    });
}

/// The points of a surface, wherever its meshes have them, at every query time; and each vertex is on its point.
TEST_P(AlembicScene, PointsAtEveryQueryTime) {
    int surfaces = 0;
    check_at_every_time([&](std::size_t t, const ScenePose& frame, const json& object) {
        const double seconds = truth["query_times"][t];
        const char* kind = object.contains("polymesh") ? "polymesh" : object.contains("subd") ? "subd" : nullptr;
        if (kind == nullptr) return;
        const json& at = object[kind]["at"][t];
        const int node = find_node(scene, object["path"]);
        int shown = 0;
        for (std::size_t i = 0; i < frame.instances.size(); ++i) {
            if (frame.instances[i].node != node || !frame.shown[i]) continue;
            const auto number = static_cast<std::size_t>(frame.instances[i].mesh);
            const Mesh& mesh = scene.meshes[number];
            const int cache =
                mesh.subdivision.cage == no_index ? mesh.deformation.points : scene.cages[mesh.subdivision.cage].points;
            const std::vector<glm::dvec3> points = sample_points(scene.point_caches[cache], seconds);
            ASSERT_EQ(points.size(), at["count"]) << object["path"] << seconds;
            const json& first6 = at["first6_positions_lerp"];
            for (std::size_t k = 0; k < first6.size(); ++k)
                EXPECT_NEAR(points[k / 3][static_cast<int>(k % 3)], first6[k].get<double>(), 1e-6)
                    << object["path"] << " at " << seconds << " point " << k / 3;
            ++shown;
            if (mesh.subdivision.cage != no_index) continue;
            const auto& posed = frame.meshes[number].positions;
            for (std::size_t v = 0; v < mesh.deformation.vertex_points.size(); ++v) {
                const glm::dvec3 p = posed.empty() ? glm::dvec3(mesh.positions[v]) : posed[v];
                EXPECT_EQ(p, points[mesh.deformation.vertex_points[v]]) << object["path"];
            }
        }
        EXPECT_GE(shown, 1) << object["path"] << seconds;
        ++surfaces;
    });
    EXPECT_GE(surfaces, GetParam() == "polymesh_anim" ? 30 : 0);
}

INSTANTIATE_TEST_SUITE_P(All, AlembicScene, testing::ValuesIn(all_archives()),
                         [](const auto& archive) { return archive.param; });

TEST(AlembicTiming, RateAndRangeAreTheArchives) {
    const auto timing = [](const std::string& name) {
        const Scene scene = load(name);
        return std::pair{scene.film.frame_rate, frame_range(scene)};
    };
    EXPECT_EQ(timing("xform_uniform"), (std::pair{FrameRate{24, 1}, FrameRange{1, 10}}));
    EXPECT_EQ(timing("camera_anim"), (std::pair{FrameRate{24, 1}, FrameRange{1, 6}}));
    EXPECT_EQ(timing("polymesh_anim"), (std::pair{FrameRate{24, 1}, FrameRange{0, 7}}));
    EXPECT_EQ(timing("xform_acyclic"), (std::pair{FrameRate{24, 1}, FrameRange{0, 48}}));
}

TEST(AlembicInstances, ShareMeshesAndPoints) {
    const Scene scene = load("instances");
    const std::vector<int>& source = node_at(scene, "/prototypes/box/boxShape").meshes;
    ASSERT_EQ(source.size(), 1u);
    for (const char* path : {"/layout/place0/boxInst/boxShape", "/layout/place1/boxInst/boxShape",
                             "/layout/place2/boxInst/boxShape", "/layout/shapeOnly/shapeInst"})
        EXPECT_EQ(node_at(scene, path).meshes, source) << path;
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.point_caches.size(), 1u);
}

TEST(AlembicVisibility, ExplicitOnesShowBelowAHiddenParent) {
    const Scene scene = load("xform_uniform");
    const Track<double>& hand = node_at(scene, "/world/arm/hand").visible;
    EXPECT_EQ(hand.interpolation, Interpolation::nearest);
    EXPECT_EQ(evaluate(hand, 1.0 / 24.0), 2.0);   // stored 1
    EXPECT_EQ(evaluate(hand, 5.0 / 24.0), 0.0);   // stored 0
    EXPECT_EQ(evaluate(hand, 10.0 / 24.0), 1.0);  // stored -1
}

/// All 16 numbers interpolate in the archive; the camera of the scene follows from them.
TEST(AlembicCameras, FieldOfViewAndShiftAtEveryQueryTime) {
    const Scene scene = load("camera_anim");
    const json truth = truth_of("camera_anim");
    for (const char* path : {"/camRig/shotCam", "/staticCam"}) {
        const json& camera = object_of(truth, path)["camera"];
        for (const json& at : camera["at"]) {
            const auto core = at["core_lerp"].get<std::vector<double>>();
            const ScenePose frame = pose(scene, at["time"]);
            const auto values = std::ranges::find(frame.cameras, find_node(scene, path), &CameraValues::node);
            ASSERT_NE(values, frame.cameras.end());
            const double aperture = core[vertical_aperture], width = core[horizontal_aperture];
            EXPECT_NEAR(values->fov, 2.0 * std::atan(10.0 * aperture / (2.0 * core[focal_length])), 1e-7) << path;
            // Offsets are in units of the film, shifts in heights of the picture.
            EXPECT_NEAR(values->shift_x, core[horizontal_offset] / aperture, 1e-12);
            EXPECT_NEAR(values->shift_y, core[vertical_offset] / aperture, 1e-12);
            EXPECT_NEAR(values->focus_distance, core[focus_distance], 1e-12);
            EXPECT_NEAR(values->near_plane, core[near_plane], 1e-15);
            EXPECT_EQ(values->aperture, 0.0);
            EXPECT_GT(width, 0.0);
        }
        for (const json& sample : camera["samples"]) {
            const std::vector<double> core{sample["focalLength"],          sample["horizontalAperture"],
                                           sample["horizontalFilmOffset"], sample["verticalAperture"],
                                           sample["verticalFilmOffset"],   sample["lensSqueezeRatio"],
                                           sample["overscanLeft"],         sample["overscanRight"],
                                           sample["overscanTop"],          sample["overscanBottom"]};
            const FilmWindow window = film_window(core, glm::dmat3(1.0));
            // The reference library adds the overscan, a share of the half frame.
            const double half = core[vertical_aperture] / core[horizontal_aperture];
            const json& expected = sample["screenWindow_top_bottom_left_right"];
            EXPECT_NEAR(window.top + half * core[overscan_top], expected[0], 1e-12);
            EXPECT_NEAR(window.bottom - half * core[overscan_bottom], expected[1], 1e-12);
            EXPECT_NEAR(window.left - core[overscan_left], expected[2], 1e-12);
            EXPECT_NEAR(window.right + core[overscan_right], expected[3], 1e-12);
        }
    }
    EXPECT_TRUE(has_warning(scene, "f-stop"));
}

TEST(AlembicCameras, FilmBackOperationsCompose) {
    const std::vector<double> channels{0.5, -0.25, 2.0, 3.0};
    const glm::dmat3 m = film_back_matrix({"t window", "s"}, channels);
    const glm::dvec3 p = m * glm::dvec3(1.0, 1.0, 1.0);  // the last acts first
    EXPECT_EQ(p, glm::dvec3(2.5, 2.75, 1.0));
    const std::vector<double> rows{1, 0, 0, 0, 1, 0, 7, 8, 1};  // translation in the third row
    EXPECT_EQ(film_back_matrix({"m"}, rows) * glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(7.0, 8.0, 1.0));
    EXPECT_THROW(film_back_matrix({"q"}, rows), std::invalid_argument);
    EXPECT_THROW(film_back_matrix({"m", "t"}, rows), std::invalid_argument);
}

}  // namespace
}  // namespace aleph
