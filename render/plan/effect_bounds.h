#pragma once
// Light at most: what surfaces can receive, reflect and show, from boxes and brightness alone. The bounds of several
// effects are made of it. All radiances are before exposure.

#include <limits>

#include "render/plan/effect_facts.h"

namespace aleph {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

double distance_to(const Bounds& box, const glm::dvec3& point);

/// True if all of a box lies in the plane of a flat object.
bool is_in_plane(const ObjectFacts& flat, const Bounds& box);

/// Sets ObjectFacts::lit_radiance. The functions below need it.
void bound_direct_light(FrameFacts& facts);

/// Illuminance that a light can bring to surfaces in a box, without shadows. Infinite where a point light may touch it.
double largest_illuminance(const LightFacts& light, const Bounds& box);

double largest_diffuse(const FrameFacts& facts);
double largest_direct_radiance(const FrameFacts& facts);

/// Radiance that a ray can meet, without the highlights of lights that have no area.
double largest_radiance(const FrameFacts& facts, int bounces);

/// Largest f cos of the lobes that have a width, 1/sr: F D G2 / (4 n.v) at its peak.
double lobe_peak(const MaterialFacts& material);

/// Radiance that an object's lobes can have from lights without area.
double largest_highlight(const FrameFacts& facts, const ObjectFacts& object);

/// The sum of powers of an albedo, from power `first` to `last`.
double sum_powers(double albedo, int first, int last);

}  // namespace aleph
