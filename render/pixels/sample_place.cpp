#include "render/pixels/sample_place.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/pixels/pixel_samples.h"

namespace aleph {

float find_spacing(const RenderSettings& settings, int index) {
    const auto first_of_stage = static_cast<unsigned>(std::max(index + 1, own_samples));
    const int count = settings.sampling.rule == Sampling::uniform
                          ? settings.sampling.spp
                          : std::min(settings.sampling.spp, static_cast<int>(std::bit_ceil(first_of_stage)));
    return 1.0f / std::sqrt(static_cast<float>(count));
}

SamplePlace make_sample_place(const RenderSettings& settings, const Lens& lens, bool blended, std::uint32_t noise_key,
                              int index) {
    SamplePlace place;
    place.index = index;
    place.centered = settings.sampling.spp == 1;
    place.spacing = find_spacing(settings, index);
    place.lens = lens;
    place.filter = settings.picture.filter;
    place.seed = settings.seed;
    place.noise_key = noise_key;
    place.blend = blended ? Blend::random : Blend::cutout;
    return place;
}

}  // namespace aleph
