// Materials, subdivision surfaces, operation stacks and transforms of archives; archives that scenes include.

#include "engine/alembic/alembic.h"
#include "engine/pose/pose.h"
#include "engine/scene/operations.h"
#include "engine/scene/points.h"
#include "engine/surface/limit_surface.h"
#include "tests/engine/alembic/fixture.h"

namespace aleph {
namespace {

TEST(AlembicMaterials, AssignmentsToTheMeshAndToFaceSets) {
    const Scene scene = load("materials_facesets");
    ASSERT_EQ(node_named(scene, "box").meshes.size(), 3u);
    const auto part = [&](const std::string& material) -> const Mesh& {
        for (const int mesh : node_named(scene, "box").meshes) {
            const Mesh& m = scene.meshes[mesh];
            if (scene.materials[m.material].name == material) return m;
        }
        throw std::out_of_range(material);
    };
    EXPECT_EQ(part("red").triangles.size(), 2u);  // face 4: the sides and face 5 are assigned away
    ASSERT_EQ(scene.materials.size(), 3u);
    for (const Material& material : scene.materials) EXPECT_EQ(material.gloss.metallic, Track<double>(0.0));
    const auto close = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-6; };
    const Material& red = scene.materials[part("red").material];
    EXPECT_TRUE(close(red.base_color.values[0], {0.8, 0.1, 0.05}));
    EXPECT_NEAR(red.gloss.roughness.values[0], 0.25, 1e-7);
    // Two are called blue: the sides' own, and one that the archive does not have.
    std::size_t triangles = 0;
    for (const int mesh : node_named(scene, "box").meshes) triangles += scene.meshes[mesh].triangles.size();
    EXPECT_EQ(triangles, 12u);
    EXPECT_TRUE(has_warning(scene, "no material \"/materials/red/blue\""));
    EXPECT_TRUE(has_warning(scene, "face set changes over time"));
}

TEST(AlembicSubdivision, CreasesCornersHolesAndRules) {
    const Scene scene = load("subd_creases");
    const json truth = truth_of("subd_creases");
    const json& object = object_of(truth, "/cage");
    const json& sample = object["subd"]["samples"][0];
    const Cage& cage = scene.cages[mesh_of(scene, "cage").subdivision.cage];
    EXPECT_EQ(cage.scheme, Cage::Scheme::catmull_clark);
    EXPECT_EQ(cage.boundary, Cage::Boundary::edge_only);          // 2
    EXPECT_EQ(cage.uv_rule, Cage::UvRule::linear_corners_plus1);  // 1, corners not propagated
    EXPECT_EQ(cage.creases.points, sample["creaseIndices"].get<std::vector<int>>());
    EXPECT_EQ(cage.creases.lengths, sample["creaseLengths"].get<std::vector<int>>());
    EXPECT_EQ(cage.creases.sharpness, sample["creaseSharpnesses"].get<std::vector<float>>());
    EXPECT_EQ(cage.corners.points, sample["cornerIndices"].get<std::vector<int>>());
    EXPECT_EQ(cage.corners.sharpness, sample["cornerSharpnesses"].get<std::vector<float>>());
    EXPECT_EQ(cage.faces.holes, sample["holes"].get<std::vector<int>>());

    // Faces backwards, each with its texture coordinates.
    const auto indices = property_of(object, ".faceIndices")["samples"][0][2].get<std::vector<int>>();
    const auto uv = object["subd"]["uv"]["expanded_samples"][0][1].get<std::vector<float>>();
    ASSERT_EQ(cage.faces.sizes, std::vector<int>(6, 4));
    for (std::size_t f = 0; f < 6; ++f) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t ours = 4 * f + i, theirs = 4 * f + (4 - i) % 4;
            EXPECT_EQ(cage.faces.points[ours], indices[theirs]);
            const glm::vec2 found = cage.uv[cage.faces.uv[ours]];
            EXPECT_EQ(found, glm::vec2(uv[2 * theirs], 1.0f - uv[2 * theirs + 1]));
        }
    }
    const Cage& plain = scene.cages[mesh_of(scene, "tetra").subdivision.cage];
    EXPECT_EQ(plain.boundary, Cage::Boundary::none);
    EXPECT_EQ(plain.uv_rule, Cage::UvRule::linear_all);
    EXPECT_TRUE(plain.faces.holes.empty());
    for (const char* name : {"cage", "tetra"}) EXPECT_GT(mesh_of(scene, name).triangles.size(), 50u);
}

DraftObject draft_xform(const std::vector<DraftProperty>& properties) {
    return {"x", "schema=AbcGeom_Xform_v3", {draft_compound(".xform", properties)}, {}};
}

TEST(AlembicSubdivision, ASurfaceWhoseFacesAreAllHolesDrawsNothing) {
    const Scene scene = load({draft_subd("hidden", {draft_points}, {{3}}, {{0, 1, 2}},
                                         {draft_array<int>(".holes", DraftProperty::i32, 1, {{0, 0}})}),
                              draft_triangle("shown")});
    EXPECT_TRUE(node_named(scene, "hidden").meshes.empty());
    EXPECT_EQ(mesh_of(scene, "shown").triangles.size(), 1u);
}

TEST(AlembicTransforms, MoreThan256ChannelsComeAsAnArray) {
    std::vector<double> channels;
    for (int i = 0; i < 90; ++i) channels.insert(channels.end(), {1.0, 0.0, i == 0 ? 0.5 : 0.0});
    const auto operations = draft_scalar<std::uint8_t>(".ops", DraftProperty::u8, {DraftBytes(90, 0x13)});
    const Scene scene =
        load({draft_xform({operations, draft_array<double>(".vals", DraftProperty::f64, 1, {channels})})});
    EXPECT_EQ(pose(scene, 0.0).world[find_node(scene, "/x")][3], glm::dvec4(90.0, 0.0, 0.5, 1.0));
}

TEST(AlembicTransforms, MissingPartsAreTheIdentity) {
    const auto operations = draft_scalar<std::uint8_t>(".ops", DraftProperty::u8, {{0x00, 0x10, 0x40}});
    for (const std::vector<DraftProperty>& properties : {std::vector<DraftProperty>{}, {operations}}) {
        const Scene scene = load({draft_xform(properties)});
        EXPECT_EQ(pose(scene, 0.0).world[find_node(scene, "/x")], glm::dmat4(1.0));
    }
}

/// A shutter as long as the frame: the sample that closes one frame and the one that opens the next share a time.
TEST(AlembicTransforms, CyclesThatTouch) {
    const ScratchFolder folder;
    OgawaDraft draft;
    draft.cyclic = true;
    draft.times = {0.0, 1.0};
    draft.period = 1.0;
    std::vector<std::vector<float>> points;
    for (const float z : {0.0f, 1.0f, 5.0f, 2.0f}) points.push_back({0, 0, z, 1, 0, z, 0, 1, z});
    const Scene scene =
        load_scene(write_draft(folder / "c.abc", draft.finish({draft_mesh("m", points, {{3}}, {{0, 1, 2}})})));
    const PointCache& cache = scene.point_caches.at(0);
    EXPECT_EQ(sample_points(cache, 0.5)[0].z, 0.5);
    EXPECT_EQ(sample_points(cache, 1.0)[0].z, 1.0);
    EXPECT_EQ(sample_points(cache, 1.5)[0].z, 1.5);
    EXPECT_EQ(sample_points(cache, 2.0)[0].z, 2.0);
}

/// A scene file that includes an archive: its own rate and range count, the content hangs below its node.
TEST(AlembicInclude, HangsBelowANodeOfASceneFile) {
    const ScratchFolder folder;
    std::filesystem::copy_file(archive_path("polymesh_anim"), folder / "p.abc");
    std::ofstream(folder / "s.json") << R"({"aleph": 1, "fps": 30, "frames": [0, 8], "nodes": [
        {"name": "stage", "translation": [0, 5, 0], "include": "p.abc"}]})";
    const Scene scene = load_scene(folder / "s.json");
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{30, 1}));
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 8}));
    ASSERT_EQ(scene.source.includes.size(), 1u);
    const ScenePose frame = pose(scene, 2.0 / 24.0), own = pose(load("polymesh_anim"), 2.0 / 24.0);
    const Scene alone = load("polymesh_anim");
    for (const char* name : {"wave", "pentagon", "growing"}) {
        const auto at = static_cast<std::size_t>(&node_named(scene, name) - scene.nodes.data());
        const auto there = static_cast<std::size_t>(&node_named(alone, name) - alone.nodes.data());
        EXPECT_EQ(frame.world[at][3], own.world[there][3] + glm::dvec4(0, 5, 0, 0)) << name;
        EXPECT_EQ(scene.nodes[at].include, 0);
    }
    save_scene(scene, folder / "again.json");
    Scene again = load_scene(folder / "again.json");
    again.source.file = scene.source.file, again.source.warnings = scene.source.warnings;
    EXPECT_EQ(again.nodes, scene.nodes);
    EXPECT_EQ(again.meshes, scene.meshes);
    EXPECT_EQ(again.point_caches, scene.point_caches);
}

using Kind = OperationStack::Kind;

glm::dvec3 apply(const OperationStack& stack, double seconds, const glm::dvec3& point) {
    return glm::dvec3(evaluate(stack, seconds) * glm::dvec4(point, 1.0));
}

/// A third of a turn about the diagonal passes x to y to z.
TEST(OperationStack, TheAxisNeedNotBeUnit) {
    const auto turn = [](std::vector<double> channels) {
        return apply({{Kind::rotate}, {}, std::move(channels)}, 0.0, {1.0, 2.0, 3.0});
    };
    expect_near(turn({7.0, 7.0, 7.0, 2.0 * pi / 3.0}), {3.0, 1.0, 2.0}, 4e-15);
    EXPECT_EQ(turn({0.0, 0.0, 0.0, 1.0}), glm::dvec3(1.0, 2.0, 3.0));
}

TEST(OperationStack, ChannelsInterpolateOneByOneAndHoldOutside) {
    OperationStack stack;
    stack.operations = {Kind::rotate_z, Kind::translate};
    stack.sampling.kind = TimeSampling::Kind::acyclic;
    stack.sampling.times = {1.0, 2.0, 4.0};
    stack.channels = {0.0, 1.0, 0.0, 0.0, /**/ 2.0 * pi, 3.0, 0.0, 0.0, /**/ 2.0 * pi, 3.0, 0.0, 0.0};
    expect_near(apply(stack, 1.5, {0, 0, 0}), {-2.0, 0.0, 0.0}, 1e-15);  // half of a whole turn, half way out
    EXPECT_EQ(evaluate(stack, 0.0), evaluate(stack, 1.0));
    EXPECT_EQ(evaluate(stack, 9.0), evaluate(stack, 4.0));
    EXPECT_EQ(evaluate(stack, 2.7), evaluate(stack, 4.0));  // equal samples: the very matrix
    EXPECT_TRUE(is_animated(stack));
    stack.channels[4] = 0.0, stack.channels[5] = 1.0, stack.channels[8] = 0.0, stack.channels[9] = 1.0;
    EXPECT_FALSE(is_animated(stack));
}

}  // namespace
}  // namespace aleph
