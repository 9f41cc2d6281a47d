#include "render/settings/measure.h"

#include <sys/resource.h>

#include <algorithm>
#include <vector>

namespace aleph {

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double median_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing) {
    std::vector<float> values;
    for (std::size_t i = 0; i < estimate.size(); i += 16) values.push_back(luminance(estimate.pixels[i]));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return viewing.display_white * *middle;
}

}  // namespace aleph
