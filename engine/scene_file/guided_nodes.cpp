// Reads "look_at" and "follow_path". Their keys are made in bake_guided_nodes.cpp.

#include "engine/scene_file/guided_nodes.h"

#include <fmt/format.h>

#include "engine/scene/transforms.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

void refuse_beside(const JsonRef& node, const char* key, std::initializer_list<const char*> others) {
    for (const char* other : others) {
        const auto found = node.find(other);
        if (found) found->fail(fmt::format("a node has either \"{}\" or \"{}\", not both", key, other));
    }
}

glm::dvec3 read_up(const JsonRef& at) {
    const glm::dvec3 up = safe_normalize(read_dvec3(at));
    if (up == glm::dvec3(0.0)) at.fail("\"up\" cannot be zero");
    return up;
}

void read_look_at(SceneReader& reader, const JsonRef& at, const JsonRef& node, int index) {
    refuse_beside(node, "look_at", {"rotation", "matrix", "operations"});
    reader.charge(sizeof(LookAt) + sizeof(Node) + 600, at, "fewer nodes can look at something");
    LookAt look{.node = index, .place = at.pointer()};
    if (at.json().is_string()) {
        look.target = at.string();
    } else {
        look.point = read_vector(at, reader.scene.film.frame_rate, any_value);
    }
    if (const auto up = node.find("up")) look.up = read_up(*up);
    reader.guided.looks.push_back(std::move(look));
}

std::vector<glm::dvec3> read_path_points(SceneReader& reader, const JsonRef& at) {
    constexpr std::size_t point_bytes = 400;  // with its part of the curve
    reader.charge(at.array_size() * point_bytes, at, "the path has too many points");
    std::vector<glm::dvec3> points;
    for (const JsonRef point : at.elements()) points.push_back(read_dvec3(point));
    return points;
}

void read_follow_path(SceneReader& reader, const JsonRef& at, const JsonRef& node, int index) {
    refuse_beside(node, "follow_path", {"translation", "matrix", "operations"});
    reader.charge(sizeof(FollowPath) + sizeof(Node) + 600, at, "fewer nodes can follow paths");
    const JsonRef points = at.require("points"), share = at.require("at");
    const auto closed = at.find("closed"), align = at.find("align"), up = at.find("up");
    const bool is_closed = closed && closed->boolean();
    FollowPath path{.node = index,
                    .place = at.pointer(),
                    .curve = PathCurve(read_path_points(reader, points), is_closed),
                    .closed = is_closed,
                    .at = read_number(share, reader.scene.film.frame_rate, is_closed ? any_value : zero_to_one),
                    .align = align && align->boolean()};
    if (!(path.curve.length() > 0.0)) points.fail("the path has no length: all its points coincide");
    if (is_closed && path.curve.point_count() < 3) points.fail("a closed path needs three different points");
    if (path.align) refuse_beside(node, "align", {"rotation", "look_at"});
    if (up && !path.align) up->fail("\"up\" goes with \"align\": true");
    if (up) path.up = read_up(*up);
    reader.guided.paths.push_back(std::move(path));
}

}  // namespace

void read_guides(SceneReader& reader, const JsonRef& at, int node) {
    const auto look = at.find("look_at"), up = at.find("up"), path = at.find("follow_path");
    if (up && !look) up->fail("\"up\" goes with \"look_at\"");
    if (look) read_look_at(reader, *look, at, node);
    if (path) read_follow_path(reader, *path, at, node);
}

}  // namespace aleph
