#include "render/surface/node_paths.h"

#include <fmt/format.h>

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

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;  // in UTF-8
}

}  // namespace

std::string name_or_number(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

NodePaths::NodePaths(const Scene& scene) {
    std::unordered_map<std::uint64_t, std::uint32_t> times;  // by the hash of a path
    marks_.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        Mark mark{.hash = hash_of_nothing};
        if (node.parent != no_index) {
            mark = marks_[node.parent];
            ++mark.depth;
        }
        std::string own = "/" + name_or_number(node.name, "node", marks_.size());
        const std::uint64_t unnumbered = continue_hash(mark.hash, own);
        mark.hash = unnumbered;
        std::string number;
        for (std::uint32_t count = ++times[unnumbered]; count > 1; count = ++times[unnumbered]) {
            number = fmt::format("#{}", count);
            mark.hash = continue_hash(unnumbered, number);
            if (times.emplace(mark.hash, 1).second) break;  // another node may be called "name#2"
        }
        own += number;
        mark.length += own.size();
        mark.text += own;
        constexpr std::size_t start = kept_of_path + 1;  // the byte after tells whether a character is split
        if (mark.text.size() > longest_path) mark.text.erase(start, mark.text.size() - start - kept_of_path);
        marks_.push_back(std::move(mark));
    }
}

std::string NodePaths::operator[](std::size_t node) const {
    const auto& [text, hash, length, depth] = marks_[node];
    if (length <= longest_path) return text;
    std::size_t start = kept_of_path, end = text.size() - kept_of_path;
    while (start > kept_of_path - 3 && continues_character(text[start])) --start;
    while (end < text.size() - kept_of_path + 3 && continues_character(text[end])) ++end;
    return fmt::format("{}...{:016x}...{}", text.substr(0, start), hash, text.substr(end));
}

}  // namespace aleph
