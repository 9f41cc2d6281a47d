#pragma once
// The indirect light of a frame at its pixel centres, from the irradiance cache and from dense gathers, and what
// separates them. Light is the luminance of what a surface reflects of its indirect irradiance, in cd/m2.

#include <CLI/CLI.hpp>

#include "engine/image/image_file.h"
#include "scenes/studies/study_frame.h"

namespace aleph {

/// Indirect light of every pixel, and what it cost.
struct CachedLight {
    Image<float> light;            ///< cd/m2; 0 where nothing reflects diffusely
    Image<float> records;          ///< irradiance values computed at each pixel
    std::size_t record_count = 0;  ///< irradiance values in all
    std::size_t late = 0;          ///< those of them that were gathered for one pixel alone, where no record was found
    std::uint64_t gather_rays = 0, shadow_rays = 0;
    // Of a processor.
    double fill_seconds = 0.0, late_seconds = 0.0;
    double lookup_seconds = 0.0;  ///< of the look-ups alone
    std::size_t lookups = 0;      ///< of shading

    double rays() const { return static_cast<double>(gather_rays + shadow_rays); }
    double seconds() const { return fill_seconds + late_seconds + lookup_seconds; }
};

/// Fills a cache and reads it at every pixel centre, as a frame with one sample per pixel does.
/// @param alpha  accuracy of every pixel
CachedLight compute_cached_light(const StudyFrame& frame, const RenderSettings& settings, const Image<float>& alpha);

/// The pixels where light is compared: one of every block, any of it with equal chance. Pixels at equal distances would
/// all or none lie on an edge that runs along the picture's sides.
struct PixelGrid {
    int step = 4;  ///< pixels, side of a block

    int count(int pixels) const { return (pixels + step - 1) / step; }
    /// @param column, row  of the block
    glm::ivec2 pixel(int column, int row, int width, int height) const;
};

/// Dense gathers at the pixels of a grid, without the cache, one value per block: two halves with random numbers of
/// their own, which no other gather shares. Their difference tells the noise.
struct ReferenceLight {
    Image<float> halves[2];  ///< cd/m2; below 0 where nothing reflects diffusely

    bool has(int x, int y) const { return halves[0](x, y) >= 0.0f; }
    double light(int x, int y) const { return 0.5 * (double{halves[0](x, y)} + halves[1](x, y)); }
    /// Square root of its expected square is the standard error.
    double deviation(int x, int y) const { return 0.5 * (double{halves[0](x, y)} - halves[1](x, y)); }
};

/// @param strata  rays per pixel, of both halves
ReferenceLight gather_reference(const StudyFrame& frame, const RenderSettings& settings, const PixelGrid& grid,
                                int strata, const std::function<void(double fraction)>& progress);

/// References that are kept in a folder, since they take minutes.
struct ReferenceOptions {
    int strata = 16384;  ///< rays per pixel, of both halves
    PixelGrid grid;
    std::string folder = "build/references";
    bool remake = false;  ///< even if there is a file
};

/// --strata, --every, --references, --remake.
void add_reference_options(CLI::App& app, ReferenceOptions& options);

/// Reads the file of this scene, frame and size if it exists, else gathers and writes it.
/// @param file  of the scene; its bytes are part of the reference's name
/// @throws InputError if the reference has another size
ReferenceLight load_or_gather_reference(const StudyFrame& frame, const RenderSettings& settings,
                                        const std::string& file, const ReferenceOptions& options, bool quiet);

/// Errors over the pixels of a grid.
struct LightError {
    std::size_t pixels = 0;
    /// Mean of (L - R)^2 / (R^2 + e^2), e = 1 % of the mean of R; also without the worst .1 % of the pixels.
    double relative_mse = 0.0, relative_mse_most = 0.0;
    double noise_mse = 0.0;            ///< what the reference's noise adds to it on average
    double bias = 0.0;                 ///< mean of L - R over the mean of R
    std::vector<double> ratios;        ///< |L - R| over the pixel's threshold, ascending
    double noise_percentile_99 = 0.0;  ///< of the reference's own |deviation| over the threshold

    double worst() const { return ratios.empty() ? 0.0 : ratios.back(); }
    /// Percent of the pixels whose error is above so many thresholds.
    double percent_beyond(double thresholds) const;
};

/// @param threshold  cd/m2, of the whole frame
LightError measure_light(const Image<float>& light, const ReferenceLight& reference, const PixelGrid& grid,
                         const Image<float>& threshold);

/// |L - R| / R at the grid's pixels; 0 where there is no reference.
Image<float> relative_error_map(const Image<float>& light, const ReferenceLight& reference, const PixelGrid& grid);

}  // namespace aleph
