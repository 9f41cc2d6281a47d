#include "render/pixels/pixel_samples.h"

#include <glm/geometric.hpp>

#include "perception/noise_threshold.h"

namespace aleph {

namespace {

constexpr float least_cosine = 0.9f;            // between the true normals of one face
constexpr float least_shading_cosine = 0.999f;  // between normals with about the same irradiance
constexpr float widest_step = 2.0f;             // footprints across a face
constexpr int enough_irradiances = 4;

/// Luminance and red-green signal.
glm::dvec2 find_signal(const glm::dvec3& light) {
    return {luminance(Rgb(light)), red_green_worth * glm::dot(red_green_weights, Rgb(light))};
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
    for (std::size_t part = 0; part < parts_.size(); ++part) parts_[part] += glm::dvec3(light.parts[part]);
    control_ += glm::dvec3(light.control);
    end_sample();
}

std::optional<Rgb> PixelSamples::find_irradiance(const SampleLight& light) const {
    if (irradiance_.count < enough_irradiances || !first_.has_surface(light.place)) return std::nullopt;
    return irradiance_.sum / static_cast<float>(irradiance_.count);
}

void PixelSamples::keep_mean() {
    if (!kept_mean_) kept_mean_ = mean();
}

/// 1 for each channel whose error is seen, 0 for those that both halves, and the mean less three standard errors, show
/// white.
/// @param first, second  means of the halves
glm::dvec3 PixelSamples::find_shown_channels(const glm::dvec3& first, const glm::dvec3& second) const {
    if (taken_ < white_samples) return glm::dvec3(1.0);
    const double white = white_, share = 1.0 - 3.0 * std::sqrt(variance()) / luminance_.mean;
    const glm::dvec3 sure = glm::min(share * glm::dvec3(mean()), glm::min(first, second));
    return {sure.x > white ? 0.0 : 1.0, sure.y > white ? 0.0 : 1.0, sure.z > white ? 0.0 : 1.0};
}

/// After 2, 4, 8, ... samples, compares the halves.
void PixelSamples::end_sample() {
    ++taken_;
    if ((taken_ & (taken_ - 1)) != 0) return;
    const int second_valid = valid_ - first_half_.valid;
    if (first_half_.valid > 0 && second_valid > 0) {
        const double first = first_half_.valid, second = second_valid;
        const double share = first * second / ((first + second) * (first + second));
        glm::dvec3 before(0.0), after(0.0);  // of the halves
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            before += first_half_.parts[part] / first;
            after += (parts_[part] - first_half_.parts[part]) / second;
        }
        const glm::dvec3 shown = find_shown_channels(before, after);
        const auto square = [&](const glm::dvec3& difference) {
            const glm::dvec2 signal = find_signal(shown * difference);
            return static_cast<float>(share * glm::dot(signal, signal));
        };
        for (std::size_t part = 0; part < parts_.size(); ++part)
            error_.parts[part] =
                square(first_half_.parts[part] / first - (parts_[part] - first_half_.parts[part]) / second);
        error_.total = square(before - after);
        error_.uncorrected =
            square(before - after - (first_half_.control / first - (control_ - first_half_.control) / second));
        error_.samples = valid_;
    }
    first_half_ = {parts_, control_, valid_};
}

}  // namespace aleph
