#include "render/pixels/pixel_samples.h"

#include <glm/geometric.hpp>

#include "perception/noise_threshold.h"

namespace aleph {

namespace {

constexpr float least_cosine = 0.9f;            // between the true normals of one face
constexpr float least_shading_cosine = 0.999f;  // between normals with about the same irradiance
constexpr float widest_step = 2.0f;             // footprints across a face
constexpr int enough_irradiances = 4;

glm::dvec2 find_signal(const Rgb& light) {
    return {luminance(light), red_green_worth * glm::dot(red_green_weights, light)};
}

}  // namespace

bool SampledPlace::has_face(const SampledPlace& other) const {
    if (other.instance != instance || !is_surface()) return other.instance == instance;
    const float step = std::abs(glm::dot(other.position - position, geometric));
    return glm::dot(other.geometric, geometric) >= least_cosine && step <= widest_step * other.footprint;
}

bool SampledPlace::has_surface(const SampledPlace& other) const {
    return has_face(other) && glm::dot(other.normal, normal) > least_shading_cosine;
}

void PixelSamples::add(const SampleLight& light) {
    const Rgb total = light.total();
    radiance_ += glm::dvec3(total);
    indirect_ += light.indirect;
    ++valid_;
    if (light.place.is_surface()) ++hits_;
    if (valid_ == 1) {
        first_ = light.place;
    } else if (!first_.has_face(light.place)) {
        edge_ = true;
    }
    if (light.irradiance && irradiance_.count < enough_irradiances && first_.has_surface(light.place)) {
        irradiance_.sum += *light.irradiance;
        ++irradiance_.count;
    }
    const double y = luminance(total), difference = y - luminance_.mean;
    luminance_.mean += difference / valid_;
    luminance_.squares += difference * (y - luminance_.mean);
    for (std::size_t part = 0; part < signals_.size(); ++part) signals_[part] += find_signal(light.parts[part]);
    control_ += light.control;
    end_sample();
}

std::optional<Rgb> PixelSamples::find_irradiance(const SampleLight& light) const {
    if (irradiance_.count < enough_irradiances || !first_.has_surface(light.place)) return std::nullopt;
    return irradiance_.sum / static_cast<float>(irradiance_.count);
}

void PixelSamples::keep_mean() {
    if (!kept_mean_) kept_mean_ = mean();
}

/// After 2, 4, 8, ... samples, compares the halves.
void PixelSamples::end_sample() {
    ++taken_;
    if ((taken_ & (taken_ - 1)) != 0) return;
    const int second_valid = valid_ - first_half_.valid;
    if (first_half_.valid > 0 && second_valid > 0) {
        const double first = first_half_.valid, second = second_valid;
        const double share = first * second / ((first + second) * (first + second));
        const auto square = [share](const glm::dvec2& of) { return static_cast<float>(share * glm::dot(of, of)); };
        glm::dvec2 total(0.0);
        for (std::size_t part = 0; part < signals_.size(); ++part) {
            const glm::dvec2 difference =
                first_half_.signals[part] / first - (signals_[part] - first_half_.signals[part]) / second;
            error_.parts[part] = square(difference);
            total += difference;
        }
        error_.total = square(total);
        total.x -= first_half_.control / first - (control_ - first_half_.control) / second;
        error_.uncorrected = square(total);
        error_.samples = valid_;
    }
    first_half_ = {signals_, control_, valid_};
}

}  // namespace aleph
