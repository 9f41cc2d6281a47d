#include "render/guide/accuracy_map.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"

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

Image<float> adapt_by_own(const Image<float>& aleph, const RenderSettings& settings) {
    const auto accuracy = static_cast<float>(settings.cache.accuracy);
    Image<float> alpha = settings.guide.own_adapter->adapt(aleph, settings.cache.accuracy);
    if (!same_size(alpha, aleph) || alpha.size() != aleph.size())
        throw InputError("", "adapter", "the accuracy map has another size than the Aleph map");
    for (float& value : alpha.pixels) value = std::isnan(value) ? accuracy : std::clamp(value, 0.0f, 1.0f);
    return alpha;
}

}  // namespace

Image<float> compute_accuracy_map(const Image<float>& aleph, const RenderSettings& settings) {
    const double accuracy = settings.cache.accuracy;
    Image<float> alpha(aleph.width, aleph.height, static_cast<float>(accuracy));
    if (settings.perception.guide == Guide::none) return alpha;
    if (settings.guide.own_adapter != nullptr) return adapt_by_own(aleph, settings);
    if (settings.guide.adapter == Adapter::none) return alpha;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        alpha.pixels[i] =
            static_cast<float>(settings.guide.adapter == Adapter::compress
                                   ? compress_accuracy(accuracy, aleph.pixels[i])
                                   : scale_add_accuracy(accuracy, aleph.pixels[i], settings.guide.adapter_k));
    return alpha;
}

}  // namespace aleph
