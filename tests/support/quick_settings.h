#pragma once

#include "render/settings/settings.h"

namespace aleph {

/// All stages run, each for a short time.
inline RenderSettings quick_settings(int width, int height) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.spp = 1;
    settings.gather = 64;
    settings.light_samples = 4;
    settings.light_step = 0;  // every frame by itself
    return settings;
}

}  // namespace aleph
