#include "render/guide/accuracy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleph {

double compress_accuracy(double accuracy, double aleph) {
    if (!(accuracy > 0.0)) return 0.0;
    const double n = std::max(1.0, aleph);  // with the arguments in this order, 1 for NaN too
    if (std::isinf(n)) return 1.0;
    return std::min(1.0, accuracy * n / (1.0 + accuracy * (n - 1.0)));
}

double scale_add_accuracy(double accuracy, double aleph, double k) {
    if (!(accuracy > 0.0)) return 0.0;
    const double n = std::max(1.0, aleph);
    return std::min(1.0, accuracy + n / k);
}

namespace {

double adapt(double aleph, const RenderSettings& settings) {
    switch (settings.guide.adapter) {
        case Adapter::compress:
            return compress_accuracy(settings.cache.accuracy, aleph);
        case Adapter::scale_add:
            return scale_add_accuracy(settings.cache.accuracy, aleph, settings.guide.adapter_k);
        case Adapter::none:
            break;
    }
    return settings.cache.accuracy;
}

}  // namespace

Image<float> compute_accuracy_map(const Image<float>& aleph, const RenderSettings& settings) {
    Image<float> alpha(aleph.width, aleph.height, static_cast<float>(settings.cache.accuracy));
    if (settings.perception.guide == Guide::none) return alpha;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        alpha.pixels[i] = static_cast<float>(adapt(aleph.pixels[i], settings));
    return alpha;
}

}  // namespace aleph
