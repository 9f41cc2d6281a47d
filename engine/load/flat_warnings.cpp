#include "engine/load/flat_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/errors.h"
#include "engine/load/source_file.h"
#include "engine/pose/parts.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// True where the file's reader warns of nodes that shrink everything to a point, and this is one.
bool has_warning(const Scene& scene, const SceneFormats& formats, const Node& node, const glm::dmat4& world) {
    const SceneFormat* format = find_format(formats, source_file(scene, node.include));
    if (format == nullptr || !format->warns_of_points) return false;
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) largest = std::max(largest, glm::length(glm::dvec3(world[column])));
    return largest < 1e-12;
}

}  // namespace

void add_flat_warnings(Scene& scene, const SceneFormats& formats) {
    std::vector<std::uint8_t> flat(scene.nodes.size());
    for (std::size_t n = 0; n < flat.size(); ++n) flat[n] = !scene.nodes[n].meshes.empty();
    const FrameRange range = frame_range(scene);
    for (const std::int64_t frame : {range.first, range.first + (range.last - range.first) / 2, range.last}) {
        const ScenePose posed = place_nodes(scene, scene.film.frame_rate.seconds_of(frame));
        for (std::size_t n = 0; n < flat.size(); ++n)
            flat[n] = flat[n] != 0 && !has_full_rank(posed.world[n]) &&
                      !has_warning(scene, formats, scene.nodes[n], posed.world[n]);
    }
    std::size_t first = 0, count = 0;
    for (std::size_t n = flat.size(); n-- > 0;) {
        if (flat[n] == 0) continue;
        first = n;
        ++count;
    }
    if (count == 0) return;
    scene.source.warnings.push_back(
        fmt::format("node \"{}\"{}: the scale is 0, or next to it, along an axis, so nothing of it can be seen",
                    printable(scene.nodes[first].name), count > 1 ? fmt::format(" and {} more", count - 1) : ""));
}

}  // namespace aleph
