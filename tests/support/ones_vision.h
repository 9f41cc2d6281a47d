#pragma once
// The least that a model of vision can be: nothing that is seen goes unnoticed.

#include "perception/tvi.h"
#include "perception/vision_model.h"

namespace aleph {

class OnesVision final : public VisionModel {
  public:
    std::string name() const override { return "ones"; }
    std::string summary() const override { return "the same elevation everywhere"; }
    double elevation(const Stimulus& /*stimulus*/, const Presentation& /*shown*/) const override { return 1.0; }
    double threshold(double luminance) const override { return tvi(luminance); }
};

}  // namespace aleph
