#include "render/node_paths.h"

#include <fmt/format.h>

#include <map>

namespace aleph {

std::string name_or_number(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

std::vector<std::string> node_paths(const Scene& scene) {
    std::vector<std::string> paths;
    std::map<std::string, int> times;
    paths.reserve(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        std::string path = node.parent == no_index ? "" : paths[node.parent];
        path.append("/").append(name_or_number(node.name, "node", i));
        const int count = ++times[path];
        paths.push_back(count == 1 ? path : fmt::format("{}#{}", path, count));
    }
    return paths;
}

}  // namespace aleph
