#pragma once
// Names of nodes that are unique in a scene.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// `name`, or the kind and the number of an element without one: "node 3".
std::string name_or_number(const std::string& name, const char* kind, std::size_t index);

/// "/group/child" per node: the names from the root down. Nodes with equal paths get "#2", "#3", ... in node order.
/// Paths of more than `longest_path` bytes are shortened in the middle: their first and last `kept_of_path` bytes, or
/// a few fewer so that no character is split, with "...", the 64-bit FNV-1a hash of the whole path in 16 hexadecimal
/// digits, and "..." between them.
class NodePaths {
  public:
    static constexpr std::size_t longest_path = 256, kept_of_path = 115;

    explicit NodePaths(const Scene& scene);

    std::string operator[](std::size_t node) const;

    /// Number of nodes above a node.
    std::size_t depth(std::size_t node) const { return marks_[node].depth; }

  private:
    struct Mark {
        /// The path; of one longer than longest_path its first kept_of_path + 1 bytes and, at the end, at least its
        /// last kept_of_path.
        std::string text{};
        std::uint64_t hash = 0;    ///< of the whole path
        std::uint64_t length = 0;  ///< of the whole path, bytes
        std::uint32_t depth = 0;   ///< number of nodes above
    };

    std::vector<Mark> marks_;
};

}  // namespace aleph
