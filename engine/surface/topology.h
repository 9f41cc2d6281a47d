#pragma once
// A cage as OpenSubdiv's refiner. Internal to limit_surface.cpp and its parts.

#include <opensubdiv/far/topologyRefiner.h>

#include <cstddef>
#include <memory>

#include "engine/scene/scene.h"

namespace aleph {

namespace Far = OpenSubdiv::Far;

/// The cage validated and with its neighbourhoods found, not yet refined. Face-varying channel 0 is the texture
/// coordinates where the cage has them. Sharpnesses are clamped to 0..10.
/// @throws InputError (place: the cage's name)
std::unique_ptr<Far::TopologyRefiner> make_refiner(const Cage& cage, std::size_t cage_points);

}  // namespace aleph
