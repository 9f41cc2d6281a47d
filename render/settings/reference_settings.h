#pragma once
// Settings of pictures that judge others.

#include "render/settings/settings.h"

namespace aleph {

/// Settings of a reference for pictures with `settings`: traced paths without a guide, with all of the light: 16 diffuse
/// bounces or, if the settings have more, those. Size, longest path, filter and levels of cages are those of the settings.
RenderSettings traced_reference_settings(const RenderSettings& settings);

}  // namespace aleph
