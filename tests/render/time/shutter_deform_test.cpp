// Indirect light of samples at their own times beside and on meshes that deform.

#include "tests/render/time/plate.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Gives a mesh the points that it has one second after the frame.
void bend(Scene& scene, std::size_t mesh, std::vector<glm::vec3> moved) {
    Mesh& bent = scene.meshes[mesh];
    bent.deformation.points = static_cast<int>(scene.point_caches.size());
    bent.normals.clear();
    scene.point_caches.push_back({"", {}, {bent.positions, std::move(moved)}});
}

TEST(ShutterDeform, NothingIsKnownWhereLampsTurnOrGrow) {
    const auto is_known = [](float radians, float growth) {
        Plate plate;
        plate.scene.meshes[2] = make_quad(0.02, 0.02, add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(5.0)));
        std::vector<glm::vec3> moved = plate.scene.meshes[2].positions;
        const glm::quat turn = glm::angleAxis(radians, glm::vec3(0.0f, 1.0f, 0.0f));
        for (glm::vec3& p : moved) p = turn * p * growth;
        bend(plate.scene, 2, moved);
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_TRUE(is_known(0.02f, 1.01f));
    EXPECT_FALSE(is_known(0.2f, 1.0f));
    EXPECT_FALSE(is_known(0.0f, 1.1f));
    EXPECT_FALSE(is_known(0.0f, 0.9f));
}

/// The plate and a box are one mesh.
TEST(ShutterDeform, NothingIsKnownBesideOtherPartsOfAMeshThatMove) {
    const auto is_known = [](const glm::vec3& plate_moves, const glm::vec3& box_moves, float reach) {
        Plate plate;
        Mesh& mesh = plate.scene.meshes[1];
        const auto corners = static_cast<std::uint32_t>(mesh.positions.size());
        const Mesh box = make_box(glm::dvec3(0.2), 0);
        for (const glm::vec3& p : box.positions) mesh.positions.push_back(p + glm::vec3(0.3f, 0.0f, 0.2f));
        for (const glm::uvec3& t : box.triangles) mesh.triangles.push_back(t + corners);
        for (std::vector<glm::vec2>& uv : mesh.uv) uv.clear();
        std::vector<glm::vec3> moved = mesh.positions;
        for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += v < corners ? plate_moves : box_moves;
        bend(plate.scene, 1, moved);
        return find_middle(plate.scene, 0.15f, reach).has_value();
    };
    const glm::vec3 rest(0.0f), aside(0.05f, 0.0f, 0.0f);
    EXPECT_TRUE(is_known(aside, aside, 0.051f)) << "they move as one";
    EXPECT_TRUE(is_known(rest, aside, 0.051f));
    EXPECT_FALSE(is_known(rest, aside, 0.049f)) << "the box moves farther than records reach";
}

}  // namespace
}  // namespace aleph
