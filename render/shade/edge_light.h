#pragma once
// Emission in pixels at bright edges. A camera ray that meets emission needs no shading: these pixels take it from
// camera rays alone, as many as it needs, before their first sample. Samples then find the rest of the light.
// Rays to lamps are spread over the parts of them that lie in the pixel's filter, and weighed by it: all meet a lamp
// that covers a thousandth of the filter, where nothing hides it.

#include "render/shade/bright_edges.h"
#include "render/shade/progressive.h"
#include "render/shade/sample_shading.h"

namespace aleph {

/// Light that a pixel shows of lamps, and of the environment, by themselves.
struct EdgeLight {
    int x = 0, y = 0;
    bool sky = false;                 ///< all of the environment is in the mean
    std::size_t first = 0, last = 0;  ///< its own in BrightEdges::pieces
    Rgb mean{0.0f};                   ///< over the pixel's filter
    float variance = 0.0f;            ///< of the mean's luminance, as parts of its rays tell it
};

/// Pixels at bright edges, row by row.
struct EdgeLights {
    EdgeLights() = default;
    EdgeLights(BrightEdges found, std::vector<EdgeLight> light);

    BrightEdges edges;
    std::vector<EdgeLight> pixels;
    Image<int> places;  ///< in `pixels`; empty: there are none

    /// Null where no bright edge is.
    const EdgeLight* find(int x, int y) const {
        return places.empty() || places(x, y) == no_index ? nullptr : &pixels[places(x, y)];
    }
};

/// Finds what pixels at bright edges show, at the shutter's centre. Sets of rays, each twice as many as those before
/// and with random numbers of its own, are cast until one is told to be the last by those before it: the mean of that
/// one alone has no bias. It is where the energy of the errors around, if they are all as large, is a quarter of what
/// pixels may have, or where they tell white and nothing changes while the shutter is open.
/// @param place  of the first sample
/// @param plan   for tolerances and white. With no tolerances there is one set, of 16 rays for each sample
EdgeLights find_edge_light(const SampleScene& scene, const SamplePlace& place, const SamplingPlan& plan,
                           BrightEdges edges, std::uint64_t& rays_cast);

/// The mean of 16 rays, those of the sample's number. While the shutter is open, what it is more at the sample's time
/// than at the shutter's centre is added to the centre's light: nothing where all that they meet is at rest.
/// @param scene, task  of one time
Rgb sample_edge_light(const SampleScene& scene, RayTask& task, const SamplePlace& place, const BrightEdges& edges,
                      const EdgeLight& edge);

/// The light that the hit of a sample's ray shows by itself, as far as it is in the pixel's EdgeLight.
Rgb light_in_edge(const SampleScene& scene, RayTask& task, const SamplePlace& place, const BrightEdges& edges,
                  const EdgeLight& edge, const Hit& hit, const glm::vec3& direction);

}  // namespace aleph
