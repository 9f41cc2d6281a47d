#include "render/pixels/pixel_samples.h"

#include <glm/geometric.hpp>

namespace aleph {

namespace {

constexpr float least_cosine = 0.9f;            // between the true normals of one face
constexpr float least_shading_cosine = 0.999f;  // between normals with about the same irradiance
constexpr float widest_step = 2.0f;             // footprints across a face
constexpr int enough_irradiances = 4;

}  // namespace

void PixelSamples::add(const SampleLight& light) {
    const Rgb total = light.total();
    radiance_ += glm::dvec3(total);
    indirect_ += light.indirect;
    ++valid_;
    if (light.instance != no_index) ++hits_;
    if (valid_ == 1) {
        instance_ = light.instance;
        position_ = light.position;
        geometric_ = light.geometric;
        normal_ = light.normal;
    } else if (!is_on_first_face(light)) {
        edge_ = true;
    }
    if (light.irradiance && irradiances_ < enough_irradiances && is_first_surface(light)) {
        irradiance_ += *light.irradiance;
        ++irradiances_;
    }
    const double y = luminance(total), difference = y - mean_;
    mean_ += difference / valid_;
    squares_ += difference * (y - mean_);
    for (std::size_t part = 0; part < luminances_.size(); ++part) luminances_[part] += luminance(light.parts[part]);
    end_sample();
}

/// Returns whether a sample saw the first one's object, about parallel to it and not a step behind or before it.
bool PixelSamples::is_on_first_face(const SampleLight& light) const {
    if (light.instance != instance_ || instance_ == no_index) return light.instance == instance_;
    const float step = std::abs(glm::dot(light.position - position_, geometric_));
    return glm::dot(light.geometric, geometric_) >= least_cosine && step <= widest_step * light.footprint;
}

bool PixelSamples::is_first_surface(const SampleLight& light) const {
    return is_on_first_face(light) && glm::dot(light.normal, normal_) > least_shading_cosine;
}

std::optional<Rgb> PixelSamples::find_irradiance(const SampleLight& light) const {
    if (irradiances_ < enough_irradiances || !is_first_surface(light)) return std::nullopt;
    return irradiance_ / static_cast<float>(irradiances_);
}

/// After 2, 4, 8, ... samples, compares the halves.
void PixelSamples::end_sample() {
    ++taken_;
    if ((taken_ & (taken_ - 1)) != 0) return;
    const int second_valid = valid_ - first_valid_;
    if (first_valid_ > 0 && second_valid > 0) {
        const double first = first_valid_, second = second_valid;
        const double share = first * second / ((first + second) * (first + second));
        double total = 0.0;
        for (std::size_t part = 0; part < luminances_.size(); ++part) {
            const double difference = first_half_[part] / first - (luminances_[part] - first_half_[part]) / second;
            error_.parts[part] = static_cast<float>(share * difference * difference);
            total += difference;
        }
        error_.total = static_cast<float>(share * total * total);
        error_.samples = valid_;
    }
    first_half_ = luminances_;
    first_valid_ = valid_;
}

}  // namespace aleph
