#include "render/surface/media.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr int max_surfaces = 64;  // that the ray of find_media passes

Media::Medium make_medium(const SurfacePoint& surface, const SurfaceMaterial& material) {
    return {surface.material, material.glass.ior, material.glass.attenuation};
}

}  // namespace

Rgb transmit(const Rgb& attenuation, float distance) {
    Rgb left(1.0f);
    for (int c = 0; c < 3; ++c) {
        if (attenuation[c] > 0.0f) left[c] = std::exp(-attenuation[c] * distance);
    }
    return left;
}

int Media::find(int material) const {
    for (int i = size_ - 1; i >= 0; --i) {
        if (stack_[i].material == material) return i;
    }
    return no_index;
}

Rgb Media::attenuation_inside() const {
    return size_ > 0 ? stack_[size_ - 1].attenuation : Rgb(0.0f);
}

Rgb Media::attenuation(const SurfacePoint& end, const SurfaceMaterial& material) const {
    if (size_ > 0) return attenuation_inside();
    return material.glass.volume && !end.front ? material.glass.attenuation : Rgb(0.0f);
}

Rgb Media::attenuation_towards(const glm::vec3& direction, const SurfacePoint& start,
                               const SurfaceMaterial& material) const {
    if (!material.glass.volume || glm::dot(start.geometric, direction) >= 0.0f) return attenuation(start, material);
    Media behind = *this;
    behind.pass(start, material);
    return behind.attenuation_inside();
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

void Media::enter(const SurfacePoint& surface, const SurfaceMaterial& material) {
    if (size_ < static_cast<int>(stack_.size())) stack_[size_++] = make_medium(surface, material);
}

bool Media::leave(int material) {
    const int inside = find(material);
    if (inside == no_index) return false;
    std::copy(stack_.begin() + inside + 1, stack_.begin() + size_, stack_.begin() + inside);
    --size_;
    return true;
}

void Media::enclose(const SurfacePoint& surface, const SurfaceMaterial& material) {
    if (size_ == static_cast<int>(stack_.size())) return;
    std::copy_backward(stack_.begin(), stack_.begin() + size_, stack_.begin() + size_ + 1);
    stack_[0] = make_medium(surface, material);
    ++size_;
}

void Media::pass(const SurfacePoint& surface, const SurfaceMaterial& material) {
    if (surface.front) {
        enter(surface, material);
    } else {
        leave(surface.material);
    }
}

Media find_media(const ShadingScene& shading, Tracer& tracer, Ray ray, std::uint64_t& counts) {
    Media around;
    if (!shading.has_volumes) return around;
    Media entered;  // on the way
    for (int surface = 0; surface < max_surfaces; ++surface) {
        ++counts;
        const Hit hit = tracer.intersect(ray);
        if (hit.instance == no_index) break;
        const auto [point, material, view] =
            view_surface(shading, make_surface_point(shading, hit, ray.direction), -ray.direction, {});
        ray.origin = point.position - point.geometric * point.offset;
        if (!material.glass.volume) continue;
        if (point.front) {
            entered.enter(point, material);
        } else if (!entered.leave(point.material)) {
            around.enclose(point, material);
        }
    }
    return around;
}

}  // namespace aleph
