#include "scenes/studies/reference_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

constexpr std::uint32_t reference_seed_mask = 0x7265666cu;  // keeps references apart from all other random numbers
constexpr std::uint32_t grid_seed = 0x67726964u;
constexpr float no_light = -1.0f;

std::filesystem::path reference_path(const StudyFrame& frame, const RenderSettings& settings, const std::string& file,
                                     const ReferenceOptions& options) {
    return std::filesystem::path(options.folder) / fmt::format("{}-{}-{}x{}-{}-{}-{}.exr", scene_name(file),
                                                               frame.frame, settings.width, settings.height,
                                                               options.grid.step, options.strata, hash_file(file));
}

}  // namespace

glm::ivec2 PixelGrid::pixel(int column, int row, int width, int height) const {
    const int left = column * step, top = row * step;
    const RandomKey block{grid_seed, 0, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column)};
    const glm::vec2 at = RandomStream(block).next_2d();
    return {left + static_cast<int>(at.x * static_cast<float>(std::min(step, width - left))),
            top + static_cast<int>(at.y * static_cast<float>(std::min(step, height - top)))};
}

ReferenceLight gather_reference(const StudyFrame& frame, const RenderSettings& settings, const PixelGrid& grid,
                                int strata, const std::function<void(double fraction)>& progress) {
    const int columns = grid.count(settings.width), rows = grid.count(settings.height);
    ReferenceLight out;
    for (Image<float>& half : out.halves) half = Image<float>(columns, rows, no_light);
    const HemisphereStrata cells = choose_strata(std::max(1, strata / 2));
    const int depth = std::max(0, settings.path_depth - 2);
    const LightingContext lighting = frame.lighting();
    std::atomic<std::size_t> done{0};
    parallel_for(out.halves[0].size(), 4, [&](std::size_t begin, std::size_t end) {
        thread_local GatherScratch scratch;
        RayTask task(frame.rays);
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec2 place = grid.pixel(static_cast<int>(i) % columns, static_cast<int>(i) / columns,
                                                settings.width, settings.height);
            const int x = place.x, y = place.y;
            if (frame.centers.hits(x, y).instance == no_index) continue;
            const PixelSurface surface = surface_at(frame, x, y);
            if (!surface.material.has_diffuse()) continue;
            const Rgb reflected = reflect_unit_irradiance(surface);
            for (std::uint32_t half = 0; half < 2; ++half) {
                const RandomKey key{settings.seed ^ reference_seed_mask, static_cast<std::uint32_t>(frame.frame),
                                    surface.pixel, half};
                const Rgb irradiance =
                    gather_irradiance(lighting, task, surface.point, cells, key, scratch, {depth}).irradiance;
                out.halves[half].pixels[i] = static_cast<float>(frame.display_luminance(reflected * irradiance));
            }
        }
        done += end - begin;
        if (progress) progress(static_cast<double>(done) / static_cast<double>(out.halves[0].size()));
    });
    return out;
}

void add_reference_options(CLI::App& app, ReferenceOptions& options) {
    add_value(app, "--strata", options.strata, "rays of the reference per pixel");
    add_value(app, "--every", options.grid.step, "side of a block of pixels; the reference has one pixel of each");
    app.add_option("--references", options.folder, "folder for references, which are read if they exist")
        ->capture_default_str();
    app.add_flag(
        "--remake", options.remake,
        "gather the reference again: needed after a change of the renderer, and of files that the scene includes");
}

ReferenceLight load_or_gather_reference(const StudyFrame& frame, const RenderSettings& settings,
                                        const std::string& file, const ReferenceOptions& options, bool quiet) {
    constexpr const char* names[] = {"half1.Y", "half2.Y"};
    const PixelGrid& grid = options.grid;
    const std::filesystem::path path = reference_path(frame, settings, file, options);
    ReferenceLight reference;
    if (!options.remake && std::filesystem::exists(path)) {
        const ChannelImage image = read_image(path);
        for (int i = 0; i < 2; ++i) {
            const Image<float>* half = image.find(names[i]);
            if (!half || half->width != grid.count(settings.width) || half->height != grid.count(settings.height))
                throw InputError(path.string(), "", "is no reference of this study for this size");
            reference.halves[i] = *half;
        }
        return reference;
    }
    Progress shown("reference", 1.0, progress_look(quiet));
    reference =
        gather_reference(frame, settings, grid, options.strata, [&](double fraction) { shown.update(fraction); });
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    write_exr(path, {{{names[0], reference.halves[0]}, {names[1], reference.halves[1]}}, {}});
    return reference;
}

double LightError::percent_beyond(double thresholds) const {
    if (ratios.empty()) return 0.0;
    const auto above = ratios.end() - std::upper_bound(ratios.begin(), ratios.end(), thresholds);
    return 100.0 * static_cast<double>(above) / static_cast<double>(ratios.size());
}

LightError measure_light(const Image<float>& light, const ReferenceLight& reference, const PixelGrid& grid,
                         const Image<float>& threshold) {
    struct Pixel {
        double light, reference, deviation, threshold;
    };
    std::vector<Pixel> pixels;
    double light_sum = 0.0, reference_sum = 0.0;
    for (int y = 0; y < reference.halves[0].height; ++y) {
        for (int x = 0; x < reference.halves[0].width; ++x) {
            if (!reference.has(x, y)) continue;
            const glm::ivec2 at = grid.pixel(x, y, light.width, light.height);
            pixels.push_back(
                {light(at.x, at.y), reference.light(x, y), reference.deviation(x, y), threshold(at.x, at.y)});
            light_sum += pixels.back().light;
            reference_sum += pixels.back().reference;
        }
    }
    LightError out;
    out.pixels = pixels.size();
    if (pixels.empty()) return out;
    const double count = static_cast<double>(pixels.size());
    const double floor = 0.01 * reference_sum / count;
    std::vector<double> squares, noise_ratios;
    for (const Pixel& p : pixels) {
        const double scale = p.reference * p.reference + floor * floor, error = p.light - p.reference;
        squares.push_back(error * error / scale);
        out.noise_mse += p.deviation * p.deviation / scale / count;
        out.ratios.push_back(std::abs(error) / p.threshold);
        noise_ratios.push_back(std::abs(p.deviation) / p.threshold);
    }
    std::ranges::sort(squares);
    std::ranges::sort(out.ratios);
    std::ranges::sort(noise_ratios);
    const auto most = squares.size() - static_cast<std::size_t>(0.001 * count);
    for (std::size_t i = 0; i < squares.size(); ++i) {
        out.relative_mse += squares[i] / count;
        if (i < most) out.relative_mse_most += squares[i] / static_cast<double>(most);
    }
    out.bias = light_sum / reference_sum - 1.0;
    out.noise_percentile_99 = noise_ratios[static_cast<std::size_t>(0.99 * (count - 1.0))];
    return out;
}

Image<float> relative_error_map(const Image<float>& light, const ReferenceLight& reference, const PixelGrid& grid) {
    Image<float> map(reference.halves[0].width, reference.halves[0].height);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            if (!reference.has(x, y)) continue;
            const glm::ivec2 at = grid.pixel(x, y, light.width, light.height);
            const double found = light(at.x, at.y);
            const double truth = reference.light(x, y);
            map(x, y) = static_cast<float>(std::abs(found - truth) / std::max(truth, 1e-9));
        }
    }
    return map;
}

}  // namespace aleph
