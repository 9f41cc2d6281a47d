#pragma once
// Share of uniform light that GGX lobes reflect to the viewer.

#include "render/surface/surface_material.h"

namespace aleph {

/// The parts of the albedo that are proportional to the reflectance straight on and at grazing incidence.
struct AlbedoParts {
    float straight = 0.0f, grazing = 0.0f;
};

/// From a table; within .005.
/// @param cos_view  with the shading normal
AlbedoParts ggx_albedo(float alpha, float cos_view);

/// The widths of an anisotropic lobe count as their mean.
float mean_alpha(const SurfaceMaterial& material);

}  // namespace aleph
