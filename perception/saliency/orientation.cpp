#include "perception/saliency/orientation.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/pyramid.h"

namespace aleph {

namespace {

/// cos and sin of frequency * position along one axis; the wave of a pixel is the product of its axes'.
struct AxisWave {
    std::vector<float> cosine, sine;

    AxisWave(int size, double frequency) {
        for (int i = 0; i < size; ++i) {
            cosine.push_back(static_cast<float>(std::cos(frequency * i)));
            sine.push_back(static_cast<float>(std::sin(frequency * i)));
        }
    }
};

Image<float> compute_orientation(const Image<float>& high_pass, double degrees) {
    const double radians = degrees * std::numbers::pi / 180.0;
    const double frequency = std::numbers::pi / 2;  // per pixel of this level
    const AxisWave wave_x(high_pass.width, frequency * std::cos(radians));
    const AxisWave wave_y(high_pass.height, frequency * std::sin(radians));
    Image<float> real(high_pass.width, high_pass.height);
    Image<float> imaginary(high_pass.width, high_pass.height);
    for (int y = 0; y < high_pass.height; ++y) {
        const float cos_y = wave_y.cosine[y];
        const float sin_y = wave_y.sine[y];
        const float* const h = high_pass.row(y);
        float* const re = real.row(y);
        float* const im = imaginary.row(y);
        const float* const cos_x = wave_x.cosine.data();
        const float* const sin_x = wave_x.sine.data();
        for (int x = 0; x < high_pass.width; ++x) {
            re[x] = h[x] * (cos_x[x] * cos_y - sin_x[x] * sin_y);
            im[x] = h[x] * (sin_x[x] * cos_y + cos_x[x] * sin_y);
        }
    }
    real = low_pass(real);
    imaginary = low_pass(imaginary);
    for (std::size_t i = 0; i < real.size(); ++i) {
        const float re = real.pixels[i], im = imaginary.pixels[i];
        real.pixels[i] = std::sqrt(re * re + im * im);
    }
    return real;
}

}  // namespace

std::array<Image<float>, orientation_count> compute_orientations(const Image<float>& level) {
    Image<float> high_pass = low_pass(level);
    for (std::size_t i = 0; i < high_pass.size(); ++i) high_pass.pixels[i] = level.pixels[i] - high_pass.pixels[i];
    std::array<Image<float>, orientation_count> out;
    for (std::size_t o = 0; o < out.size(); ++o) out[o] = compute_orientation(high_pass, orientation_degrees[o]);
    return out;
}

}  // namespace aleph
