#pragma once
// Openings through which a room gets light of the sky: directions towards them are sampled there more often than
// others.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/light/light_tree.h"

namespace aleph {

/// A rectangle on a side of the box of SkyOpenings.
struct SkyOpening {
    int side = 0;                        ///< two for each axis, the upper one second
    glm::vec2 low{0.0f}, high{0.0f};     ///< m, along the other two axes
    std::array<glm::vec3, 4> corners{};  ///< m, relative to the anchor, one after the other around it
};

struct SkyOpenings {
    static constexpr std::size_t most = 8;

    glm::vec3 low{0.0f}, high{0.0f};  ///< m, relative to the anchor: a box around what is seen
    std::vector<SkyOpening> openings;
};

/// The axes of SkyOpening::low on a side of this axis.
inline std::array<int, 2> other_axes(int axis) {
    return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

/// Where a ray leaves the box.
struct BoxExit {
    int side = 0;
    float distance = 0.0f;  ///< m
    glm::vec2 at{0.0f};     ///< m, along the axes other than the side's
};

bool is_inside(const SkyOpenings& box, const glm::vec3& position);

/// @param origin  inside of the box
BoxExit leave_box(const SkyOpenings& box, const glm::vec3& origin, const glm::vec3& direction);

/// About the share of light from outside of the box that openings let in to a receiver, a little at least: what was
/// missed keeps some samples.
/// @param direction  unit, towards the light; 0: it comes from all around
float estimate_open_share(const SkyOpenings& openings, const Receiver& receiver, const glm::vec3& direction);

/// The openings that a receiver sees; none for one outside of the box.
struct SeenOpenings {
    std::array<std::array<float, 2>, SkyOpenings::most> angles{};  ///< sr, of both halves
    std::array<float, SkyOpenings::most> weights{};                ///< in proportion to the share of samples
    float total = 0.0f;                                            ///< of the weights; 0: it sees none

    float angle(std::size_t i) const { return angles[i][0] + angles[i][1]; }
};

SeenOpenings see_openings(const SkyOpenings& openings, const Receiver& receiver);

/// A unit direction towards an opening, by solid angle and cosine.
/// @param seen  by a receiver at `from`, at least one
glm::vec3 sample_openings(const SkyOpenings& openings, const SeenOpenings& seen, const glm::vec3& from, glm::vec2 u);

/// Density per steradian of sample_openings.
/// @param direction  unit
float pdf_openings(const SkyOpenings& openings, const SeenOpenings& seen, const glm::vec3& from,
                   const glm::vec3& direction);

}  // namespace aleph
