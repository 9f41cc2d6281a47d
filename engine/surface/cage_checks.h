#pragma once
// Checks of a subdivision cage before it is given to OpenSubdiv, which does not check it: a bad cage corrupts memory or
// ends the process.

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// The highest level that Cage::level and Cage::max_level may name.
inline constexpr int max_subdivision_level = 10;

/// How crowded a cage is: the sum, over its points and faces of more than 16 neighbours, of their number squared.
/// OpenSubdiv's time and memory grow with it; at most `max_crowding` (one point of 2048 neighbours takes 1 s).
/// @param cage  with indices in range
std::size_t measure_crowding(const Cage& cage, std::size_t cage_points);
inline constexpr std::size_t max_crowding = std::size_t{1} << 22;

/// Refuses faces of fewer than 3 or of repeated points, indices out of range, too crowded cages, a sharp edge at an
/// inner point of two edges, Loop faces that are no triangles, arrays that do not fit each other, infinite numbers.
/// @param cage_points  how many points the cage's point cache has
/// @throws InputError (place: the cage's name)
void validate(const Cage& cage, std::size_t cage_points);

/// Warnings about a valid cage: creases that follow no edge (ignored), faces that repeat another, edges of
/// more than two faces (they become sharp).
std::vector<std::string> list_warnings(const Cage& cage);

/// Number of parts of a valid cage.
int count_parts(const Cage& cage);

/// Triangles of all parts, holes included, at a level; at least 1 where some face is no quad (Loop: triangle).
std::size_t count_triangles(const Cage& cage, int level);

/// Calls visit(a, b, sharpness) for every edge of every crease.
template <class Visit>
void for_each_crease_edge(const Cage& cage, const Visit& visit) {
    std::size_t begin = 0;
    for (std::size_t c = 0; c < cage.creases.lengths.size(); ++c) {
        const auto length = static_cast<std::size_t>(cage.creases.lengths[c]);
        for (std::size_t i = begin; i + 1 < begin + length; ++i) {
            visit(cage.creases.points[i], cage.creases.points[i + 1], cage.creases.sharpness[c]);
        }
        begin += length;
    }
}

}  // namespace aleph
