#include "render/surface/media.h"

#include <algorithm>

namespace aleph {

int Media::find(int material) const {
    for (int i = size_ - 1; i >= 0; --i) {
        if (stack_[i].material == material) return i;
    }
    return no_index;
}

Rgb Media::attenuation_inside() const {
    return size_ > 0 ? stack_[size_ - 1].attenuation : Rgb(0.0f);
}

Rgb Media::attenuation(const ViewedSurface& end) const {
    if (size_ > 0) return attenuation_inside();
    return end.material.glass.volume && !end.point.front ? end.material.glass.attenuation : Rgb(0.0f);
}

float Media::ratio_at(const ViewedSurface& surface) const {
    if (surface.point.front) return surface.material.glass.ior / ior();
    const int inside = find(surface.point.material);
    const int outer = inside == no_index ? size_ - 1 : (inside == size_ - 1 ? size_ - 2 : size_ - 1);
    const float outer_ior = outer >= 0 ? stack_[outer].ior : 1.0f;
    // A ray that is in another medium as well leaves this one without noticing: the innermost counts.
    const float inner = inside == no_index ? surface.material.glass.ior : ior();
    return inner > 0.0f ? outer_ior / inner : 0.0f;
}

void Media::pass(const ViewedSurface& surface) {
    if (surface.point.front) {
        if (size_ < static_cast<int>(stack_.size())) {
            stack_[size_++] = {surface.point.material, surface.material.glass.ior, surface.material.glass.attenuation};
        }
        return;
    }
    const int inside = find(surface.point.material);
    if (inside == no_index) return;
    std::copy(stack_.begin() + inside + 1, stack_.begin() + size_, stack_.begin() + inside);
    --size_;
}

}  // namespace aleph
