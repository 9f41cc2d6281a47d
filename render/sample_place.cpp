#include "render/sample_place.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr int most_fill_samples = 4;  // of a pixel: where light is needed beside them, they mostly found it

}  // namespace

int fill_samples(const RenderSettings& settings) {
    return std::min(settings.spp, most_fill_samples);
}

SamplePlace make_sample_place(const RenderSettings& settings, const CameraView& view, const Lens& lens, bool blended,
                              int index) {
    // Samples are not counted beforehand, except where they are uniform.
    const int count = settings.sampling == Sampling::uniform ? settings.spp : std::min(settings.spp, 4);
    SamplePlace place;
    place.index = index;
    place.centered = settings.spp == 1;
    place.spacing = 1.0f / std::sqrt(static_cast<float>(count));
    place.lens = lens;
    place.filter = settings.filter;
    place.seed = settings.seed;
    place.moment = make_view_key(view);
    place.blend = blended ? Blend::random : Blend::cutout;
    return place;
}

}  // namespace aleph
