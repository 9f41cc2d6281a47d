// Validator: the node graph and the scenes.
#include <fmt/format.h>

#include <set>

#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

void check_node_transform(const JsonRef& node) {
    const bool translates = node.check_numbers("translation", 3), rotates = node.check_numbers("rotation", 4),
               scales = node.check_numbers("scale", 3);
    if (!node.check_numbers("matrix", 16)) return;
    const JsonRef matrix = node.require("matrix");
    if (translates || rotates || scales) matrix.fail("a node has either a matrix or translation, rotation and scale");
    for (const std::size_t i : {3u, 7u, 11u, 15u}) {
        const JsonRef element = matrix[i];
        if (element.number() != (i == 15 ? 1.0 : 0.0)) element.fail("the matrix is not affine");
    }
}

void check_node(const GltfCheck& check, const JsonRef& node) {
    node.find_string("name");
    node.find_index("mesh", check.count("meshes"), "mesh");
    node.find_index("camera", check.count("cameras"), "camera");
    check_node_transform(node);
    if (const ExtensionRef light(node, "KHR_lights_punctual"); light)
        light->require("light").index(check.light_count(), "light");
}

/// Every node has at most one parent and none is above itself. Without recursion: chains of 10^5 nodes are fine.
/// @return per node whether it has a parent
std::vector<bool> check_graph(const GltfCheck& check) {
    const std::size_t count = check.count("nodes");
    std::vector<std::vector<std::size_t>> children(count);
    std::vector<bool> has_parent(count, false);
    for_each_object(check.root, "nodes", [&](const JsonRef& node, std::size_t i) {
        for_each_element(node, "children", [&](const JsonRef& child, std::size_t) {
            const std::size_t index = child.index(count, "node");
            if (index == i) child.fail(fmt::format("node {} is its own child: the node graph has a cycle", i));
            if (has_parent[index]) child.fail(fmt::format("node {} has two parents", index));
            has_parent[index] = true;
            children[i].push_back(index);
        });
    });
    // As each has one parent at most, a node that no root reaches lies on a cycle or below one.
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < count; ++i) {
        if (!has_parent[i]) open.push_back(i);
    }
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        reached[i] = true;
        open.insert(open.end(), children[i].begin(), children[i].end());
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (reached[i]) continue;
        const JsonRef nodes = check.root.require("nodes");
        const JsonRef node = nodes[i];
        node.fail(fmt::format("node {} lies on a cycle of the node graph, or below one", i));
    }
    return has_parent;
}

}  // namespace

void check_nodes(GltfCheck& check) {
    for_each_object(check.root, "nodes", [&](const JsonRef& node, std::size_t) { check_node(check, node); });
    const std::vector<bool> has_parent = check_graph(check);
    for_each_object(check.root, "scenes", [&](const JsonRef& scene, std::size_t) {
        scene.find_string("name");
        std::set<std::size_t> seen;
        for_each_element(scene, "nodes", [&](const JsonRef& root, std::size_t) {
            const std::size_t index = root.index(check.count("nodes"), "node");
            if (has_parent[index]) root.fail(fmt::format("node {} has a parent and cannot be a root", index));
            if (!seen.insert(index).second) root.fail(fmt::format("node {} is listed twice", index));
        });
    });
    const std::size_t scenes = check.count("scenes");
    check.root.find_index("scene", scenes, "scene");
    if (scenes > 1) {
        check.warn(check.root, fmt::format("of {} scenes only the default one is read", scenes));
    }
}

}  // namespace aleph
