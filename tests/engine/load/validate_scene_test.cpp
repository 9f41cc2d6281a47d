// Scenes made in code: what does not fit is named.

#include "engine/load/validate_scene.h"
#include "tests/engine/load/full_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Fault {
    std::string message;
    std::function<void(Scene&)> make;
};

void expect_refused(const Fault& fault) {
    Scene scene = make_full_scene();
    fault.make(scene);
    EXPECT_EQ(find_refusal([&] { validate(scene); }).message, fault.message);
}

TEST(ValidateScene, AcceptsWhatFits) {
    EXPECT_NO_THROW(validate(make_full_scene()));
    EXPECT_NO_THROW(validate(Scene()));
}

TEST(ValidateScene, IndicesNameElements) {
    for (const Fault& fault : std::vector<Fault>{
             {R"(node 0 "ball": refers to mesh 999, but there are only 3)",
              [](Scene& s) { s.nodes[0].meshes = {999}; }},
             {R"(node 0 "ball": refers to mesh -1, but there are only 3)", [](Scene& s) { s.nodes[0].meshes = {-1}; }},
             {R"(node 1 "eye": refers to parent 7, but there are only 2)", [](Scene& s) { s.nodes[1].parent = 7; }},
             {R"(node 0 "ball": its parent has to stand before it)", [](Scene& s) { s.nodes[0].parent = 1; }},
             {R"(node 1 "eye": refers to camera 1, but there is only 1)", [](Scene& s) { s.nodes[1].camera = 1; }},
             {R"(node 0 "ball": refers to light -2, but there is only 1)", [](Scene& s) { s.nodes[0].light = -2; }},
             {R"(material 0: refers to image 3, but there is only 1)",
              [](Scene& s) { s.materials[0].textures[TextureSlot::emission].image = 3; }},
             {R"(material 0: base_color_texture: texture coordinates 0 and 1 exist, not 2)",
              [](Scene& s) { s.materials[0].textures[TextureSlot::base_color].uv_set = 2; }},
             {R"(mesh 0 "rigid": refers to material 5, but there is only 1)",
              [](Scene& s) { s.meshes[0].material = 5; }},
             {R"(mesh 0 "rigid": a triangle has vertex 400, but there are 4)",
              [](Scene& s) { s.meshes[0].triangles[0].y = 400; }},
             {R"(mesh 0 "rigid": refers to cage 0, but there are none)",
              [](Scene& s) { s.meshes[0].subdivision.cage = 0; }},
             {R"(mesh 1 "skinned": refers to skin 2, but there is only 1)",
              [](Scene& s) { s.meshes[1].deformation.skin = 2; }},
             {R"(mesh 1 "skinned": refers to joint 1, but there is only 1)",
              [](Scene& s) { s.meshes[1].deformation.joint_weights[2].joint = 1; }},
             {R"(mesh 2 "cached": refers to point cache 1, but there is only 1)",
              [](Scene& s) { s.meshes[2].deformation.points = 1; }},
             {R"(mesh 2 "cached": a vertex uses point 9, but the cache has 4)",
              [](Scene& s) {
                  s.meshes[2].deformation.vertex_points = {0, 1, 2, 9};
              }},
             {R"(skin 0: refers to node 2, but there are only 2)", [](Scene& s) { s.skins[0].joints[0] = 2; }},
             {R"(environment 0: refers to image 1, but there is only 1)", [](Scene& s) { s.environment.image = 1; }}}) {
        expect_refused(fault);
    }
}

TEST(ValidateScene, NumbersAreFiniteAndInRange) {
    for (const Fault& fault : std::vector<Fault>{
             {R"(node 0 "ball": the axis of its rotation has length 2; it has to be a unit vector)",
              [](Scene& s) {
                  s.nodes[0].transform.axis_rotation = AxisRotation{{0.0, 2.0, 0.0}, 0.0};
              }},
             {R"(node 0 "ball": the axis of its rotation has length 0; it has to be a unit vector)",
              [](Scene& s) {
                  s.nodes[0].transform.axis_rotation = AxisRotation{{0.0, 0.0, 0.0}, 0.0};
              }},
             {R"(frame rate: both numbers have to be above 0)", [](Scene& s) { s.film.frame_rate.denominator = 0; }},
             {R"(range: its last frame is before its first)",
              [](Scene& s) {
                  s.film.range = FrameRange{3, 2};
              }},
             {R"(exposure: has to be above 0, found nan)", [](Scene& s) { s.film.exposure = not_a_number; }},
             {R"(viewing: pixels_per_degree has to be above 0, found -31)",
              [](Scene& s) { s.film.viewing.pixels_per_degree = -31.0; }},
             {R"(camera 0: near has to be above 0, found 0)", [](Scene& s) { s.cameras[0].near_plane = 0.0; }},
             {R"(camera 0: its shutter has to close when it opens or later)",
              [](Scene& s) {
                  s.cameras[0].shutter = {0.5, 0.0};
              }},
             {R"(mesh 0 "rigid": a position is not finite)",
              [](Scene& s) { s.meshes[0].positions[1].z = float_infinity; }},
             {R"(point cache 0: a point is not finite)",
              [](Scene& s) { s.point_caches[0].positions[1][0].x = float_nan; }}}) {
        expect_refused(fault);
    }
}

TEST(ValidateScene, ArraysFitEachOther) {
    for (const Fault& fault : std::vector<Fault>{
             {R"(mesh 0 "rigid": needs as many normals as positions, or none)",
              [](Scene& s) { s.meshes[0].normals.resize(3); }},
             {R"(mesh 0 "rigid": needs as many texture coordinates as positions, or none)",
              [](Scene& s) { s.meshes[0].uv[1].resize(1); }},
             {R"(mesh 1 "skinned": needs one weight track for each morph target)",
              [](Scene& s) { s.meshes[1].deformation.target_weights.clear(); }},
             {R"(mesh 1 "skinned": needs joints_per_vertex weights for each vertex)",
              [](Scene& s) { s.meshes[1].deformation.joint_weights.pop_back(); }},
             {R"(mesh 1 "skinned": a morph target needs as many displacements as the mesh has positions, or none)",
              [](Scene& s) { s.meshes[1].deformation.targets[0].positions.pop_back(); }},
             {R"(point cache 0: its samples have different numbers of points)",
              [](Scene& s) { s.point_caches[0].positions[1].pop_back(); }},
             {R"(point cache 0: has no samples)", [](Scene& s) { s.point_caches[0].positions.clear(); }},
             {R"(skin 0: needs one inverse bind matrix for each joint)",
              [](Scene& s) { s.skins[0].inverse_binds.clear(); }},
             {R"(environment 0: the picture of the surroundings has no floating-point pixels)",
              [](Scene& s) { s.images[0].floats = {}; }}}) {
        expect_refused(fault);
    }
}

/// The reasons are those of the readers.
TEST(ValidateScene, TracksHaveKeysAndFiniteValues) {
    const auto reason_of = [](const std::function<void(Scene&)>& make) {
        Scene scene = make_full_scene();
        make(scene);
        return find_refusal([&] { validate(scene); }).message;
    };
    const std::vector<std::pair<std::string, std::function<void(Scene&)>>> faults{
        {R"(node 0 "ball": )", [](Scene& s) { s.nodes[0].transform.translation.values.clear(); }},
        {R"(node 0 "ball": )", [](Scene& s) { s.nodes[0].transform.translation = glm::dvec3(0.0, not_a_number, 0.0); }},
        {R"(node 0 "ball": )", [](Scene& s) { s.nodes[0].transform.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0); }},
        {R"(node 1 "eye": )", [](Scene& s) { s.nodes[1].transform.matrix = glm::dmat4(0.0); }},
        {R"(node 1 "eye": )",
         [](Scene& s) {
             s.nodes[1].transform.operations = OperationStack{{OperationStack::Kind::translate}, {}, {1.0, 2.0}};
         }},
        {R"(material 0: )",
         [](Scene& s) {
             s.materials[0].gloss.roughness.values = {0.1, not_a_number};
         }},
        {R"(light 0: )", [](Scene& s) { s.lights[0].intensity.values.clear(); }},
        {R"(camera 0: )", [](Scene& s) { s.cameras[0].fov = not_a_number; }},
        {R"(mesh 0 "rigid": )", [](Scene& s) { s.meshes[0].present.values.clear(); }},
        {R"(environment 0: )", [](Scene& s) { s.environment.radiance->values.clear(); }}};
    for (const auto& [place, make] : faults) EXPECT_EQ(reason_of(make).find(place), 0u) << reason_of(make);
}

}  // namespace
}  // namespace aleph
