#pragma once
// Which openings let light of the sky into the room that the camera sees.

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// Short random paths from what the camera sees tell where rays leave a box around what they meet, and reach the sky.
/// Nothing without an environment or without direct light, or where more than a third of the rays reach it: most
/// samples do then anyway. Nothing either where too few do, or through more than a third of the box. A pure function
/// of its arguments.
/// @param counts  increased, rays as RayCounts::shadow
std::optional<SkyOpenings> find_sky_openings(const LightingContext& context, const CameraView& view,
                                             const SampleHits& centers, RayCounts& counts);

/// Adds those of another time, whose coordinates are the same.
void add_openings(const SkyOpenings& other, std::optional<SkyOpenings>& openings);

/// Brings them to coordinates in which all lies elsewhere. @param shift  m
void move_openings(const glm::vec3& shift, SkyOpenings& openings);

}  // namespace aleph
