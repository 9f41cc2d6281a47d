#pragma once
// Points of limit surfaces, and the allowed outcomes for a damaged cage: it is refused with a reason, or its surface is
// valid everywhere.

#include "engine/surface/cage_checks.h"
#include "engine/surface/limit_surface.h"
#include "tests/support/scenes/subdivision_cages.h"
#include "tests/support/test.h"

namespace aleph {

struct Vertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
};

inline Vertices vertices_of(const LimitSurface& surface, const std::vector<glm::dvec3>& points, int part = 0) {
    Vertices vertices;
    surface.evaluate_vertices(part, surface.make_control_points(points), vertices.positions, vertices.normals);
    return vertices;
}

/// The limit point at (s, t) of drawn face f of a cage of quads, through a surface of level 0.
inline glm::dvec3 limit_at(const LimitSurface& surface, const std::vector<glm::dvec3>& control, int f, double s,
                           double t) {
    return s >= t ? surface.evaluate(0, control, 2 * f, s - t, t) : surface.evaluate(0, control, 2 * f + 1, s, t - s);
}

inline std::string refusal(const Cage& cage, std::size_t points) {
    const Refusal found = find_refusal([&] { validate(cage, points); });
    if (found.message.empty()) return "";
    EXPECT_EQ(found.place, "cage test");
    EXPECT_THROW(LimitSurface(cage, points, 1), InputError);
    return found.reason;
}

inline void expect_refused(const Cage& cage, std::size_t points, const std::string& part) {
    const std::string reason = refusal(cage, points);
    EXPECT_NE(reason.find(part), std::string::npos) << "'" << reason << "' lacks '" << part << "'";
}

inline void expect_sound(const LimitSurface& surface, const std::vector<glm::dvec3>& points) {
    const auto control = surface.make_control_points(points);
    for (int part = 0; part < surface.part_count(); ++part) {
        const auto& [positions, normals] = vertices_of(surface, points, part);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            ASSERT_TRUE(std::isfinite(positions[i].x + positions[i].y + positions[i].z));
            ASSERT_NEAR(glm::length(normals[i]), 1.0f, 1e-5f);
        }
        for (const glm::uvec3& t : surface.make_mesh(part, control).triangles) {
            ASSERT_LT(std::max({t.x, t.y, t.z}), positions.size());
        }
        const auto count = static_cast<int>(surface.triangles(part).size());
        for (int i = 0; i < count; i += std::max(1, count / 50)) {
            const glm::dvec3 p = surface.evaluate(part, control, i, 0.2, 0.3);
            ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
        }
    }
}

inline void expect_sound(const TestCage& test, int level = 2) {
    expect_sound(LimitSurface(test.cage, test.points.size(), level), test.points);
}

}  // namespace aleph
