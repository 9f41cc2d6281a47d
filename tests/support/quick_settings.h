#pragma once

#include "render/settings/settings.h"

namespace aleph {

/// The other settings of the picture stay.
inline void set_size(RenderSettings& settings, int width, int height) {
    settings.picture.width = width;
    settings.picture.height = height;
}

/// All stages run, each for a short time.
inline RenderSettings quick_settings(int width, int height) {
    RenderSettings settings{.picture = {.width = width, .height = height}};
    settings.sampling.spp = 1;
    settings.cache.gather = 64;
    settings.light.light_samples = 4;
    settings.cache.light_step = 0;  // every frame by itself
    return settings;
}

}  // namespace aleph
