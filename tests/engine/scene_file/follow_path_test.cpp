// Nodes that follow paths: constant speed along a smooth curve, and their direction.

#include "engine/scene_file/path_curve.h"
#include "tests/engine/scene_file/guided_poses.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

std::vector<glm::dvec3> circle_points(int count) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        points.emplace_back(std::sin(angle), 0.0, std::cos(angle));
    }
    return points;
}

std::string to_json(const std::vector<glm::dvec3>& points) {
    std::string text = "[";
    for (const glm::dvec3& p : points)
        text += fmt::format("{}[{}, {}, {}]", text.size() > 1 ? ", " : "", p.x, p.y, p.z);
    return text + "]";
}

glm::dvec3 place_of(const Scene& scene, double frame) {
    return evaluate(scene.nodes[0].transform.translation, frame_seconds(scene, frame));
}

TEST(PathCurve, LengthsOfLinesAndCircles) {
    const PathCurve line({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}}, false);
    EXPECT_NEAR(line.length(), 7.0, 1e-12);
    for (const double d : {0.0, 0.5, 1.0, 2.9, 6.9, 7.0}) expect_near(line.at(d).position, {d, 0, 0}, 1e-12);
    EXPECT_EQ(line.at(-1.0).position, glm::dvec3(0.0));
    expect_near(line.at(9.0).position, {7, 0, 0}, 1e-12);
    const PathCurve circle(circle_points(64), true);
    EXPECT_NEAR(circle.length(), 2.0 * std::numbers::pi, 2e-5);
    for (int i = 0; i < 640; ++i) {
        const PathCurve::Place place = circle.at(circle.length() * i / 640.0);
        EXPECT_NEAR(glm::length(place.position), 1.0, 1e-5);
        EXPECT_NEAR(glm::dot(place.position, place.direction), 0.0, 1e-3);
        const double angle = std::atan2(place.position.x, place.position.z);
        EXPECT_NEAR(std::remainder(angle - 2.0 * std::numbers::pi * i / 640.0, 2.0 * std::numbers::pi), 0.0, 1e-5);
    }
}

TEST(PathCurve, PassesThroughItsPointsAndIsSmoothThere) {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 2, 0}, {1.1, 2.1, 0.3}, {5, 0, 1}, {-2, 3, 4}};
    for (const bool closed : {false, true}) {
        const PathCurve curve(points, closed);
        std::size_t next = 0;
        glm::dvec3 before = curve.at(0.0).direction;
        double nearest = 9.0;
        for (int i = 0; i <= 50000 && next < points.size(); ++i) {
            const PathCurve::Place place = curve.at(curve.length() * i / 50000.0);
            EXPECT_GT(glm::dot(place.direction, before), 0.99);
            before = place.direction;
            const double distance = glm::distance(place.position, points[next]);
            if (distance > nearest && nearest < 4e-4) {
                ++next;
                nearest = 9.0;
            } else {
                nearest = distance;
            }
        }
        EXPECT_GE(next + 1, points.size());
    }
}

TEST(PathCurve, APointListedTwiceIsACorner) {
    const PathCurve corner({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}, false);
    EXPECT_NEAR(corner.length(), 2.0, 1e-12);
    expect_near(corner.at(0.5).position, {0.5, 0, 0}, 1e-12);
    expect_near(corner.at(1.5).position, {1, 0.5, 0}, 1e-12);
    expect_near(corner.at(0.999).direction, {1, 0, 0}, 1e-12);
    expect_near(corner.at(1.001).direction, {0, 1, 0}, 1e-12);
    EXPECT_EQ(PathCurve({{1, 1, 1}, {1, 1, 1}}, false).length(), 0.0);
    // A closed curve may name its first point at its end.
    const std::vector<glm::dvec3> circle = circle_points(8);
    std::vector<glm::dvec3> again = circle;
    again.push_back(circle.front());
    EXPECT_EQ(PathCurve(again, true).length(), PathCurve(circle, true).length());
}

TEST(PathCurve, TurningBackKeepsItsSpeed) {
    const PathCurve back({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, false);
    EXPECT_NEAR(back.length(), 2.0, 1e-9);
    for (int i = 0; i <= 64; ++i) {
        const double d = 2.0 * i / 64.0;
        expect_near(back.at(d).position, {d <= 1.0 ? d : 2.0 - d, 0, 0}, 1e-9);
    }
}

TEST(FollowPath, ConstantSpeedAroundACircle) {
    const Scene scene = read(R"(, "nodes": [{"name": "car", "follow_path": {"closed": true, "align": true,
        "at": {"keys": [[0, 0], [96, 1]]}, "points": )" +
                             to_json(circle_points(16)) + "}}]");
    const PathCurve curve(circle_points(16), true);
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 96}));
    double slowest = 9.0, fastest = 0.0;
    for (int part = 0; part < 96 * 8; ++part) {
        const double frame = part / 8.0;
        const glm::dvec3 here = place_of(scene, frame), next = place_of(scene, frame + 0.125);
        const double speed = glm::distance(here, next) / (curve.length() / (96 * 8));
        slowest = std::min(slowest, speed);
        fastest = std::max(fastest, speed);
        const PathCurve::Place exact = curve.at(curve.length() * frame / 96.0);
        expect_near(here, exact.position, part % 8 == 0 ? 1e-13 : 1.01e-7 * curve.length());
        const glm::dvec3 view = view_at(scene, "car", frame);
        expect_near(view, exact.direction, part % 8 == 0 ? 1e-12 : 1.01e-6);
        EXPECT_NEAR(world_at(scene, "car", frame_seconds(scene, frame))[1].y, 1.0, 1e-12);
    }
    EXPECT_GT(slowest, 0.9998);
    EXPECT_LT(fastest, 1.0002);
    expect_near(place_of(scene, 6.0), circle_points(16)[1], 1e-12);
    expect_near(place_of(scene, 96.0), circle_points(16)[0], 1e-15);
    EXPECT_TRUE(again(scene) == scene);
}

TEST(FollowPath, EasedAndOverSeveralLaps) {
    const Scene scene = read(R"(, "nodes": [{"name": "car", "follow_path": {"closed": true,
        "at": {"interpolation": "ease", "keys": [[0, -1], [40, 1.5]]}, "points": [[1, 0, 0], [0, 0, 1], [-1, 0, 0], [0, 0, -1]]},
        "rotation": {"axis": [0, 1, 0], "degrees": 40}, "scale": 2}])");
    expect_near(place_of(scene, 0.0), {1, 0, 0}, 1e-12);
    expect_near(place_of(scene, 20.0), {0, 0, 1}, 1e-9);  // at 0.25
    expect_near(place_of(scene, 40.0), {-1, 0, 0}, 1e-9);
    EXPECT_TRUE(scene.nodes[0].transform.axis_rotation.has_value());
    // At rest at both ends.
    EXPECT_LT(glm::distance(place_of(scene, 0.0), place_of(scene, 0.1)), 1e-3);
    EXPECT_LT(glm::distance(place_of(scene, 39.9), place_of(scene, 40.0)), 1e-3);
}

TEST(FollowPath, AlignedBelowAParentWithAnUpOfItsOwn) {
    const Scene scene =
        read(R"(, "frames": [0, 20], "nodes": [{"name": "wall", "rotation": {"axis": [1, 0, 0], "degrees": 90},
        "children": [{"name": "snail", "follow_path": {"points": [[0, 0, 0], [2, 0, 0]], "at": {"keys": [[0, 0], [20, 1]]},
          "align": true, "up": [0, 0, 3]}}]}])");
    for (const int frame : {0, 7, 20}) {
        const glm::dmat4 world = world_at(scene, "snail", frame_seconds(scene, frame));
        expect_near(glm::dvec3(world[3]), {frame / 10.0, 0, 0}, 1e-14);
        expect_near(view_of(world), {1, 0, 0}, 1e-14);
        expect_near(glm::dvec3(world[1]), {0, -1, 0}, 1e-14);
    }
}

TEST(FollowPath, ACameraOnAPathLooksAtAnotherNodeOnAPath) {
    const Scene scene = read(R"(, "frames": [0, 24], "nodes": [
        {"name": "eye", "follow_path": {"points": [[0, 1, 5], [2, 1, 4], [3, 2, 0]], "at": {"keys": [[0, 0], [24, 1]]}},
         "look_at": "car", "camera": {}},
        {"name": "car", "follow_path": {"points": [[-2, 0, 0], [0, 0, -1], [0, 0, -1], [2, 0, 0]], "at": {"keys": [[0, 1], [24, 0]]}, "align": true}}])");
    for (int part = 0; part <= 24 * 4; ++part) {
        EXPECT_LT(miss_angle(scene, "eye", "car", frame_seconds(scene, part / 4.0)), part % 4 == 0 ? 1e-13 : 1.1e-6);
    }
    // The way of the points, also for a car that moves backwards.
    expect_near(view_at(scene, "car", 0.0), glm::normalize(glm::dvec3(2, 0, 1)), 1e-12);
}

TEST(FollowPath, StandsStillWhereAtIsConstant) {
    const Scene scene = read(R"(, "frames": [0, 1000000], "nodes": [
        {"name": "car", "follow_path": {"points": [[0, 0, 0], [4, 0, 0]], "at": 0.25, "align": true}}])");
    EXPECT_EQ(scene.nodes[0].transform.translation.values.size(), 1u);
    expect_near(place_of(scene, 5.0), {1, 0, 0}, 1e-14);
    EXPECT_EQ(scene.nodes[0].transform.rotation.values.size(), 1u);
}

}  // namespace
}  // namespace aleph
