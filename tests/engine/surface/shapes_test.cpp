// Shapes: closed, outward, analytic normals, upright images.

#include <tuple>

#include "tests/engine/surface/shape_cases.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

// Triangles are counter-clockwise from their side in space, and so in (u, -v): images are not mirrored.
TEST(Shapes, ArraysAgreeAndTrianglesFaceTheirSide) {
    for (const Shape& shape : all_shapes()) {
        const Mesh mesh = make_shape_mesh(shape, 7, "name");
        EXPECT_EQ(mesh.name, "name");
        EXPECT_EQ(mesh.material, 7);
        EXPECT_EQ(mesh.shape, shape);
        EXPECT_EQ(mesh.triangles.size(), shape_triangle_count(shape));
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.uv[0].size(), mesh.positions.size());
        EXPECT_TRUE(mesh.uv[1].empty());
        for (const glm::uvec3& triangle : mesh.triangles) {
            const Corners c = corners(mesh, triangle);
            EXPECT_GT(glm::length(area_vector(c)), 1e-5) << "segments " << shape.segments;
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(glm::length(c.normal[i]), 1.0, 2e-7);
                EXPECT_GE(glm::dot(glm::normalize(area_vector(c)), c.normal[i]), 0.2) << "segments " << shape.segments;
            }
            const glm::dvec2 a = c.uv[1] - c.uv[0], b = c.uv[2] - c.uv[0];
            EXPECT_GT(-(a.x * b.y - a.y * b.x), 1e-6) << "segments " << shape.segments;
        }
    }
}

TEST(Shapes, EveryVertexIsUsedAndNoneIsThereTwice) {
    for (const Shape& shape : all_shapes()) {
        const Mesh mesh = make_shape_mesh(shape);
        std::set<std::uint32_t> used;
        for (const glm::uvec3& triangle : mesh.triangles) used.insert({triangle.x, triangle.y, triangle.z});
        EXPECT_EQ(used.size(), mesh.positions.size());
        std::set<std::array<float, 8>> different;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 p = mesh.positions[i], n = mesh.normals[i];
            different.insert({p.x, p.y, p.z, n.x, n.y, n.z, mesh.uv[0][i].x, mesh.uv[0][i].y});
        }
        EXPECT_EQ(different.size(), mesh.positions.size()) << "segments " << shape.segments;
    }
}

// With vertices at one place merged, every edge is used once in each direction: no cracks, no double triangles.
TEST(Shapes, SolidsAreClosed) {
    using Place = std::tuple<float, float, float>;
    for (const Shape& shape : all_shapes()) {
        if (shape.kind == Shape::Kind::quad) continue;
        const Mesh mesh = make_shape_mesh(shape);
        std::map<std::pair<Place, Place>, int> edges;
        const auto place = [&](std::uint32_t i) {
            const glm::vec3& p = mesh.positions[i];
            return Place(p.x, p.y, p.z);
        };
        for (const glm::uvec3& t : mesh.triangles) {
            for (int i = 0; i < 3; ++i) ++edges[{place(t[i]), place(t[(i + 1) % 3])}];
        }
        for (const auto& [edge, count] : edges) {
            EXPECT_EQ(count, 1);
            const auto opposite = edges.find({edge.second, edge.first});
            EXPECT_TRUE(opposite != edges.end() && opposite->second == 1) << "segments " << shape.segments;
        }
    }
}

TEST(Shapes, VolumesAreThoseOfThePolyhedra) {
    EXPECT_NEAR(volume(make_shape_mesh(make_shape(Shape::Kind::box))), 1.5 * 0.75 * 3.0, 1e-6);
    for (const int n : {3, 4, 5, 48}) {
        const double polygon = 0.5 * n * 0.8 * 0.8 * std::sin(2.0 * std::numbers::pi / n);
        EXPECT_NEAR(volume(make_shape_mesh(make_shape(Shape::Kind::cylinder, n))), polygon * 2.5, 1e-6);
    }
}

TEST(Shapes, SphereVerticesAndNormalsAreAnalytic) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::sphere));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::dvec3(mesh.positions[i])), 0.8, 1e-7);
        EXPECT_LT(glm::length(glm::dvec3(mesh.positions[i]) / 0.8 - glm::dvec3(mesh.normals[i])), 2e-7);
    }
}

TEST(Shapes, SphereImageFacesPlusZAndRunsCounterClockwise) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::sphere));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p = mesh.positions[i];
        const glm::dvec2 uv = mesh.uv[0][i];
        EXPECT_NEAR(uv.y, std::acos(std::clamp(p.y / 0.8, -1.0, 1.0)) / std::numbers::pi, 1e-3);
        if (std::abs(p.y) > 0.79 || std::abs(uv.x - 0.5) > 0.49) continue;  // pole and seam: u is free there
        EXPECT_NEAR(uv.x, 0.5 + std::atan2(p.x, p.z) / (2.0 * std::numbers::pi), 1e-6);
    }
}

TEST(Shapes, QuadFacesPlusZWithItsImageUpright) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::quad));
    ASSERT_EQ(mesh.positions.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(mesh.normals[i], glm::vec3(0.0f, 0.0f, 1.0f));
        const glm::vec2 uv = mesh.uv[0][i];
        EXPECT_EQ(mesh.positions[i], glm::vec3(1.5f * (uv.x - 0.5f), 0.75f * (0.5f - uv.y), 0.0f));
    }
}

TEST(Shapes, BoxSidesHaveTheirImagesUpright) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::box));
    ASSERT_EQ(mesh.positions.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
        if (mesh.normals[i].y == 0.0f) {
            EXPECT_EQ(mesh.uv[0][i].y, mesh.positions[i].y > 0.0f ? 0.0f : 1.0f);
        } else {
            EXPECT_EQ(mesh.uv[0][i].y, mesh.positions[i].z * mesh.normals[i].y > 0.0f ? 1.0f : 0.0f);
        }
    }
}

TEST(Shapes, CylinderWallUnrollsItsImage) {
    const Shape shape = make_shape(Shape::Kind::cylinder, 12);
    const Mesh mesh = make_shape_mesh(shape);
    for (std::size_t i = 0; i <= 12; ++i) {
        for (const std::size_t end : {0u, 1u}) {
            const std::size_t vertex = 13 * end + i;
            const glm::vec2 uv = mesh.uv[0][vertex];
            EXPECT_FLOAT_EQ(uv.x, static_cast<float>(i) / 12.0f);
            EXPECT_EQ(uv.y, static_cast<float>(end));
            EXPECT_FLOAT_EQ(mesh.positions[vertex].y, (end == 0 ? 0.5f : -0.5f) * static_cast<float>(shape.height));
        }
    }
}

TEST(Shapes, TextureRepeats) {
    Shape shape = make_shape(Shape::Kind::quad);
    shape.uv_scale = {4.0, 0.5};
    const Mesh mesh = make_shape_mesh(shape);
    EXPECT_EQ(mesh.uv[0][2], glm::vec2(4.0f, 0.5f));
}

TEST(Shapes, LargestAndSmallestSegmentsAreTaken) {
    EXPECT_EQ(make_shape_mesh(make_shape(Shape::Kind::cylinder, 4096)).triangles.size(), 4u * 4096u);
    EXPECT_EQ(make_shape_mesh(make_shape(Shape::Kind::sphere, 3)).triangles.size(), 6u);
}

TEST(Shapes, SizesAreChecked) {
    for (const double bad : {0.0, -0.0, -1.0, 5e-324, infinity, -infinity, not_a_number, 1e19}) {
        Shape quad = make_shape(Shape::Kind::quad), box = make_shape(Shape::Kind::box);
        Shape sphere = make_shape(Shape::Kind::sphere), cylinder = make_shape(Shape::Kind::cylinder);
        quad.size.y = bad;
        box.size.z = bad;
        sphere.radius = bad;
        cylinder.height = bad;
        for (const Shape& shape : {quad, box, sphere, cylinder})
            EXPECT_THROW(make_shape_mesh(shape), InputError) << bad;
    }
    for (const double bad : {infinity, not_a_number}) {
        Shape quad = make_shape(Shape::Kind::quad);
        quad.uv_scale.x = bad;
        EXPECT_THROW(make_shape_mesh(quad), InputError);
    }
    for (const int segments : {-1, 0, 2, 4097, std::numeric_limits<int>::max()}) {
        EXPECT_THROW(make_shape_mesh(make_shape(Shape::Kind::sphere, segments)), InputError);
        EXPECT_THROW(make_shape_mesh(make_shape(Shape::Kind::cylinder, segments)), InputError);
    }
    expect_refusal([] { validate(make_shape(Shape::Kind::sphere, 2), "a.json", "/nodes/0/shape"); }, "a.json",
                   "/nodes/0/shape", "");
}

}  // namespace
}  // namespace aleph
