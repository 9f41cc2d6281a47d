#include "render/sample_place.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr int counted_samples = 4;  // of a pixel, where their number is not known beforehand

}  // namespace

SamplePlace make_sample_place(const RenderSettings& settings, const Lens& lens, bool blended, std::uint32_t moment,
                              int index) {
    const int count = settings.sampling == Sampling::uniform ? settings.spp : std::min(settings.spp, counted_samples);
    SamplePlace place;
    place.index = index;
    place.centered = settings.spp == 1;
    place.spacing = 1.0f / std::sqrt(static_cast<float>(count));
    place.lens = lens;
    place.filter = settings.filter;
    place.seed = settings.seed;
    place.moment = moment;
    place.blend = blended ? Blend::random : Blend::cutout;
    return place;
}

}  // namespace aleph
