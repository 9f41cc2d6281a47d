#include "scenes/studies/grating.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/castle.h"
#include "perception/sensitivity.h"

namespace aleph {

namespace {

constexpr int width = 1024, height = 4;
constexpr double kernel[] = {0.05, 0.25, 0.4, 0.25, 0.05};
constexpr double clear_of_zero = 0.2;  // of the largest sum of the bands

/// Pixel i of an axis of n that is mirrored about its first and last pixel.
int mirror(int i, int n) {
    if (n == 1) return 0;
    const int period = 2 * (n - 1);
    const int j = ((i % period) + period) % period;
    return j < n ? j : period - j;
}

std::vector<double> reduce(const std::vector<double>& fine) {
    if (fine.size() == 1) return fine;
    const int n = static_cast<int>(fine.size());
    std::vector<double> coarse((fine.size() + 1) / 2, 0.0);
    for (int i = 0; i < static_cast<int>(coarse.size()); ++i) {
        for (int k = -2; k <= 2; ++k) coarse[i] += kernel[k + 2] * fine[mirror(2 * i + k, n)];
    }
    return coarse;
}

std::vector<double> expand(const std::vector<double>& coarse, std::size_t size) {
    if (size == coarse.size()) return coarse;
    const int n = static_cast<int>(size);
    std::vector<double> fine(size, 0.0);
    for (int i = 0; i < n; ++i) {
        for (int k = -2; k <= 2; ++k) {
            const int j = mirror(i + k, n);
            if (j % 2 == 0) fine[i] += 2.0 * kernel[k + 2] * coarse[j / 2];
        }
    }
    return fine;
}

double kernel_transfer(double w) {
    return 0.4 + 0.5 * std::cos(w) + 0.1 * std::cos(2.0 * w);
}

BandValues normalize(const BandValues& bands) {
    double sum = 0.0;
    for (const double band : bands) sum += band;
    BandValues responses{};
    for (std::size_t i = 0; i < bands.size(); ++i) responses[i] = bands[i] / sum;
    return responses;
}

/// (5.6) to (5.9), as printed, with the constants of Daly 1998 or Laird et al. 2006.
double kelly_elevation(Vision vision, double rho, double v) {
    const bool daly = vision == Vision::thesis;
    const double c0 = daly ? 1.14 : 0.6329, c1 = daly ? 0.67 : 0.8404, c2 = daly ? 1.7 : 0.7986;
    const double speed = daly ? v : std::max(v, 0.3);
    const double k = 6.1 + 7.3 * std::pow(std::abs(std::log10(c2 * speed / 3.0)), 3.0);
    const double rho_max = 45.9 / (c2 * speed + 2.0);
    const double angular = 2.0 * std::numbers::pi * rho * c1;
    // Laird et al. print c1 once more.
    const auto csf = [&](double a) {
        return (daly ? 1.0 : c1) * k * c0 * c2 * speed * a * a * std::exp(-2.0 * a / rho_max);
    };
    return angular > rho_max ? std::max(1.0, csf(rho_max) / std::max(csf(angular), 1.0)) : 1.0;
}

double castle_known_elevation(double rho, double retinal, double tracked, double luminance, double persistence,
                              const FrameRate& frame_rate) {
    const auto transfer = [rho](double blur) {
        if (!(blur > 0.0)) return 1.0;
        const double w = std::numbers::pi / (2.0 * blur);
        return w * w / (w * w + 4.0 * rho * rho);
    };
    const double display = persistence * tracked / frame_rate.per_second();
    const auto eye = [persistence](double v) { return persistence * (0.001648 * v + 0.079818); };
    const double hold = transfer(display) * transfer(eye(tracked)) / transfer(eye(0.0));
    return std::max(1.0,
                    castle_peak(luminance) / std::max(castle_sensitivity(rho, rho * retinal, luminance) * hold, 1.0));
}

}  // namespace

Image<Rgb> make_grating(const Grating& grating, int columns, int rows, const ViewingConditions& viewing) {
    Image<Rgb> picture(columns, rows);
    for (int x = 0; x < columns; ++x) {
        const double phase = 2.0 * std::numbers::pi * grating.rho * x / viewing.pixels_per_degree;
        const double luminance = grating.luminance * (1.0 + grating.contrast * std::cos(phase + 0.3));
        for (int y = 0; y < rows; ++y) picture(x, y) = Rgb(static_cast<float>(luminance / viewing.display_white));
    }
    return picture;
}

RowBands find_row_bands(const std::vector<double>& row) {
    std::vector<std::vector<double>> small = {row}, full = {row};
    for (std::size_t i = 1; i <= 7; ++i) {
        small.push_back(reduce(small.back()));
        std::vector<double> level = small.back();
        for (std::size_t j = i; j-- > 0;) level = expand(level, small[j].size());
        full.push_back(level);
    }
    RowBands out;
    for (std::size_t x = 0; x < row.size(); ++x) {
        BandValues bands{};
        double sum = 0.0;
        for (std::size_t i = 0; i < bands.size(); ++i) sum += bands[i] = std::abs(full[i][x] - full[i + 1][x]);
        out.responses.push_back(normalize(bands));
        out.sums.push_back(sum);
    }
    return out;
}

BandValues transfer_responses(double rho, const ViewingConditions& viewing) {
    BandValues bands{};
    double gain = 1.0, w = 2.0 * std::numbers::pi * rho / viewing.pixels_per_degree;
    for (double& band : bands) {
        const double next = gain * kernel_transfer(w) * kernel_transfer(w);
        band = gain - next;
        gain = next;
        w *= 2.0;
    }
    return normalize(bands);
}

double known_elevation(Vision vision, Guide guide, double rho, const Grating& grating, double luminance,
                       const ViewingConditions& viewing, const FrameRate& frame_rate) {
    const double image = guide == Guide::spatial ? 0.0 : grating.velocity;
    const double drift = 0.15, followed = guide == Guide::spatial ? 0.0 : 0.82 * image;
    const double retinal = std::max(drift, std::abs(image - std::min(followed + drift, 80.0)));
    if (vision != Vision::castle) return kelly_elevation(vision, rho, retinal);
    return castle_known_elevation(rho, retinal, std::min(followed, 80.0), luminance, viewing.persistence, frame_rate);
}

GratingCheck check_grating(const Grating& grating, const PerceptionSettings& settings, const ViewingConditions& viewing,
                           const FrameRate& frame_rate) {
    const Image<Rgb> picture = make_grating(grating, width, height, viewing);
    const Image<float> velocity(width, height, static_cast<float>(grating.velocity));
    const PerceptionMaps maps = compute_perception(picture, velocity, viewing, frame_rate, settings);
    std::vector<double> row(width);
    for (int x = 0; x < width; ++x) row[x] = picture(x, 0).y;
    const RowBands bands = find_row_bands(row);
    const double largest = *std::ranges::max_element(bands.sums);
    const std::array<double, 7> frequencies = band_frequencies(settings.bands, viewing.pixels_per_degree);
    GratingCheck check;
    std::vector<double> values;
    for (int x = 0; x < width; ++x) {
        values.push_back(maps.aleph(x, height / 2));
        if (bands.sums[x] < clear_of_zero * largest) continue;
        const double luminance = maps.adaptation.empty() ? grating.luminance : maps.adaptation(x, height / 2);
        double known = 0.0;
        for (std::size_t i = 0; i < frequencies.size(); ++i) {
            known += bands.responses[x][i] * known_elevation(settings.vision, settings.guide, frequencies[i], grating,
                                                             luminance, viewing, frame_rate);
        }
        check.aleph = std::max(check.aleph, std::abs(values.back() / known - 1.0));
        ++check.compared;
    }
    std::ranges::nth_element(values, values.begin() + width / 2);
    check.median = values[width / 2];
    return check;
}

}  // namespace aleph
