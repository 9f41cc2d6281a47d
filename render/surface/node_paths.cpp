#include "render/surface/node_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace aleph {

namespace {

constexpr std::uint64_t hash_of_nothing = 0xcbf29ce484222325u;

/// FNV-1a, which continues with more text from the hash of the text before it.
std::uint64_t continue_hash(std::uint64_t hash, std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

std::string suffix_of(std::uint32_t count) {
    return count == 1 ? "" : fmt::format("#{}", count);
}

/// name_or_number without a copy of the name.
/// @param number  holds the text of a node without a name
std::string_view name_at(const Scene& scene, int node, std::string& number) {
    const std::string& name = scene.nodes[node].name;
    if (name.empty()) number = name_or_number(name, "node", static_cast<std::size_t>(node));
    return name.empty() ? number : name;
}

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;  // in UTF-8
}

}  // namespace

std::string name_or_number(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

NodePaths::NodePaths(const Scene& scene) : scene_(scene), marks_(scene.nodes.size()) {
    std::unordered_map<std::uint64_t, std::uint32_t> times;  // by the hash of a path
    std::string number;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
        const Node& node = scene.nodes[i];
        Mark& mark = marks_[i];
        if (node.parent == no_index) {
            mark.hash = hash_of_nothing;
        } else {
            mark = marks_[node.parent];
            ++mark.depth;
        }
        const std::string_view name = name_at(scene, static_cast<int>(i), number);
        const std::uint64_t unnumbered = continue_hash(continue_hash(mark.hash, "/"), name);
        mark.hash = unnumbered;
        mark.count = ++times[unnumbered];
        while (mark.count > 1) {  // another node may be called "name#2"
            mark.hash = continue_hash(unnumbered, suffix_of(mark.count));
            if (times.emplace(mark.hash, 1).second) break;
            mark.count = ++times[unnumbered];
        }
        mark.length += 1 + name.size() + suffix_of(mark.count).size();
        if (mark.start_node == no_index && mark.length >= kept_of_path) mark.start_node = static_cast<int>(i);
    }
}

std::string NodePaths::operator[](std::size_t node) const {
    const Mark& mark = marks_[node];
    const int index = static_cast<int>(node);
    if (mark.length <= longest_path) return end_of(index, mark.length);
    return fmt::format("{}...{:016x}...{}", start_of(mark.start_node), mark.hash, end_of(index, kept_of_path));
}

/// The first kept_of_path bytes of the path of a start_node.
std::string NodePaths::start_of(int node) const {
    const int parent = scene_.nodes[node].parent;
    std::string start = parent == no_index ? "" : end_of(parent, marks_[parent].length);
    std::string number;
    start.append("/").append(name_at(scene_, node, number).substr(0, kept_of_path));
    start.append(suffix_of(marks_[node].count)).resize(kept_of_path + 1);
    std::size_t size = kept_of_path;
    while (size > kept_of_path - 3 && continues_character(start[size])) --size;
    start.resize(size);
    return start;
}

/// The last `bytes` bytes of a node's path.
std::string NodePaths::end_of(int node, std::size_t bytes) const {
    std::string end(bytes, '\0');
    std::size_t left = bytes;
    std::string number;
    const auto prepend = [&](std::string_view text) {
        const std::size_t taken = std::min(left, text.size());
        left -= taken;
        text.substr(text.size() - taken).copy(end.data() + left, taken);
    };
    for (; left > 0; node = scene_.nodes[node].parent) {
        prepend(suffix_of(marks_[node].count));
        prepend(name_at(scene_, node, number));
        prepend("/");
    }
    std::size_t first = 0;
    while (first < std::min<std::size_t>(bytes, 3) && continues_character(end[first])) ++first;
    return end.substr(first);
}

}  // namespace aleph
