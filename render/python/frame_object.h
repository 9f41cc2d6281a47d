#pragma once
// Frames as Python sees them.

#include <pybind11/pybind11.h>

#include <memory>

#include "engine/image/image_file.h"
#include "render/frame/frame_output.h"
#include "render/settings/settings.h"

namespace aleph::python {

namespace py = pybind11;

/// The parts of a scene that the file of its frame names: film, names and materials of objects.
struct FrameOrigin {
    Scene scene;  ///< without geometry
    RenderSettings settings;
    double exposure = 1.0;
};

/// The scene without its geometry and pictures.
std::shared_ptr<const FrameOrigin> describe_origin(const Scene& scene, const RenderSettings& settings, double exposure);

struct Frame {
    FrameOutput output;
    std::shared_ptr<const FrameOrigin> origin;
};

/// The channels of the frame's file with all of its maps.
ChannelImage frame_channels(const Frame& frame);

}  // namespace aleph::python
