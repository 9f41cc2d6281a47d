#pragma once
// From the Aleph map to the ambient accuracy of every pixel, thesis 6.1.

#include "engine/base/image.h"
#include "render/settings.h"

namespace aleph {

/// (6.7) as a N / (1 + a (N - 1)): `accuracy` at aleph = 1, towards 1 at infinity, 0 at accuracy = 0.
double compress_accuracy(double accuracy, double aleph);

/// (6.8): accuracy + aleph / k, at most 1.
double scale_add_accuracy(double accuracy, double aleph, double k);

/// alpha per pixel. Without a guide it is `accuracy` everywhere, whatever the adapter (MODEL 6.1).
Image<float> compute_accuracy_map(const Image<float>& aleph, const RenderSettings& settings);

}  // namespace aleph
