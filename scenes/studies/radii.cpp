// How far irradiance values may be used: the split sphere, the Hessian, and the cache of the program, at equal rays per
// value, against dense gathers.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cache_fill.h"
#include "render/cli/options.h"
#include "render/gather_at.h"
#include "scenes/studies/cached_light.h"
#include "scenes/studies/radius_rules.h"
#include "scenes/studies/reference_light.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct RadiiOptions {
    StudyOptions study{.size = "160x120", .gather = 1024, .spp = 0};
    ReferenceOptions reference;
    std::vector<std::string> frames;
    std::vector<std::string> sphere = {".6", ".4", ".25", ".15", ".1"}, hessian = {"1e-2", "1e-3", "1e-4", "1e-5"},
                             cache = {"1", ".6", ".3", ".15"};
    bool markdown = false;
};

constexpr double normal_tolerance = 0.2;  // sqrt(1 - N.N_i), for the Hessian's values
constexpr double behind = 0.05;           // of R_i: farther below the tangent plane a value is not used
constexpr double far_away = 1e3;          // scene radii, for rays that miss
constexpr double step_share = 1e-3;       // of the distance to the nearest surface, for differences

enum class Rule { sphere, clamped, hessian };

/// A value with its gradients, and how far it is used.
struct Value {
    glm::vec3 position{0.0f}, normal{0.0f};
    IrradianceSample sample;
    float radius = 0.0f, least = 0.0f;
};

/// Values that are placed one after the other where no other is used, as in Ward, Rubinstein and Clear 1988.
class PlainCache {
  public:
    PlainCache(Rule rule, double knob) : rule_(rule), knob_(knob) {}

    /// e / alpha: below 1 the value may be used.
    double error(const Value& value, const glm::vec3& position, const glm::vec3& normal) const {
        const double cosine = glm::dot(value.normal, normal);
        const glm::vec3 offset = position - value.position;
        const double distance = glm::length(offset) / value.radius, turn = std::sqrt(std::max(0.0, 1.0 - cosine));
        if (!(cosine > 0.0)) return 2.0;
        if (0.5 * glm::dot(offset, normal + value.normal) < -behind * value.radius) return 2.0;
        if (rule_ == Rule::hessian) return std::max(distance, turn / normal_tolerance);
        return (distance + turn) / knob_;
    }

    /// The weighted mean of what the values extrapolate; nothing where none may be used.
    std::optional<Rgb> find(const glm::vec3& position, const glm::vec3& normal) const {
        Rgb sum(0.0f);
        float weights = 0.0f;
        for (const Value& value : values_) {
            const auto weight = static_cast<float>(1.0 - error(value, position, normal));
            if (!(weight > 0.0f)) continue;
            sum += weight * extrapolate_value(value, position, normal);
            weights += weight;
        }
        if (!(weights > 0.0f)) return std::nullopt;
        return sum / weights;
    }

    void insert(Value value) {
        if (rule_ == Rule::clamped) {  // Krivanek et al. 2006
            for (Value& other : values_) {
                if (!(glm::dot(other.normal, value.normal) > 0.0f)) continue;
                const float distance = glm::length(other.position - value.position);
                value.radius = std::max(value.least, std::min(value.radius, other.radius + distance));
                other.radius = std::max(other.least, std::min(other.radius, value.radius + distance));
            }
        }
        values_.push_back(value);
    }

    std::size_t size() const { return values_.size(); }

  private:
    static Rgb extrapolate_value(const Value& value, const glm::vec3& position, const glm::vec3& normal) {
        Rgb light = value.sample.irradiance;
        const glm::vec3 offset = position - value.position, turn = glm::cross(value.normal, normal);
        for (int c = 0; c < 3; ++c) {
            light[c] += glm::dot(turn, value.sample.rotation_gradient[c]) +
                        glm::dot(offset, value.sample.translation_gradient[c]);
            light[c] = std::clamp(light[c], 0.0f, 2.0f * value.sample.irradiance[c]);
        }
        return light;
    }

    Rule rule_;
    double knob_;
    std::vector<Value> values_;
};

/// What the rays of the gather met, in the tangent frame.
HemisphereMesh make_mesh(const GatherScratch& scratch, const PixelSurface& surface, int rays, double far) {
    const HemisphereStrata strata = choose_strata(rays);
    const Basis basis = make_basis(surface.point.normal);
    HemisphereMesh mesh{strata.rows, strata.columns, {}, {}};
    const auto count = static_cast<std::size_t>(strata.count());
    mesh.points.resize(count);
    mesh.radiance.resize(count);
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const auto cell = static_cast<std::size_t>(scratch.places[i].cell);
        const glm::vec3& d = scratch.rays[i].direction;
        const glm::dvec3 local(glm::dot(d, basis.tangent), glm::dot(d, basis.bitangent), glm::dot(d, basis.normal));
        mesh.points[cell] = local * std::min<double>(scratch.distances[cell], far);
        mesh.radiance[cell] = luminance(scratch.radiance[cell]);
    }
    return mesh;
}

struct Outcome {
    std::size_t values = 0;
    LightError error;
};

/// Places values from coarse to fine, so that all rules place them evenly, and reads them at every pixel.
Outcome run_rule(const StudyFrame& frame, const RenderSettings& settings, Rule rule, double knob,
                 const ReferenceLight& reference, const PixelGrid& grid, const Image<float>& threshold) {
    const LightingContext lighting = frame.lighting();
    const Image<float> alpha(settings.width, settings.height, static_cast<float>(settings.accuracy));
    const float most = scene_radius(frame.shading);
    const IndirectContext context{.lighting = lighting,
                                  .view = frame.posed.view,
                                  .settings = settings,
                                  .accuracy = alpha,
                                  .frame = static_cast<std::uint32_t>(frame.frame),
                                  .max_radius = most,
                                  .progress = {}};
    GatherScratch scratch;
    RayTask task(frame.rays);
    PlainCache cache(rule, knob);
    const auto place = [&](const PixelSurface& surface) {
        Value value{surface.point.position, surface.point.normal, {}, 0.0f, surface.footprint};
        value.sample = gather_at(context, task, surface, scratch, settings.gather);
        const float nearest = std::min(value.sample.nearest_distance, most);
        double radius = std::min(value.sample.harmonic_mean_distance, most);
        if (rule == Rule::clamped) radius = nearest;
        if (rule == Rule::hessian) {
            const HemisphereMesh mesh = make_mesh(scratch, surface, settings.gather, far_away * most);
            const glm::dmat2 hessian = mesh_hessian(mesh, std::max<double>(step_share * nearest, 1e-9 * most));
            const double light = luminance(value.sample.irradiance);
            radius = light > 0.0 ? std::min<double>(hessian_radius(hessian / light, knob * most * most), most) : most;
        }
        const double reach = rule == Rule::hessian ? 1.0 : knob;  // of a radius
        value.least = static_cast<float>(value.least / reach);
        value.radius = std::max(static_cast<float>(radius), value.least);
        cache.insert(value);
    };
    for (int stride = 32; stride >= 1; stride /= 2) {
        for (int y = 0; y < settings.height; y += stride) {
            for (int x = 0; x < settings.width; x += stride) {
                if (frame.centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = surface_at(frame, x, y);
                if (!surface.material.has_diffuse()) continue;
                if (!cache.find(surface.point.position, surface.point.normal)) place(surface);
            }
        }
    }
    Image<float> light(settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y) {
        for (int x = 0; x < settings.width; ++x) {
            if (frame.centers.hits(x, y).instance == no_index) continue;
            const PixelSurface surface = surface_at(frame, x, y);
            if (!surface.material.has_diffuse()) continue;
            const std::optional<Rgb> found = cache.find(surface.point.position, surface.point.normal);
            if (found) {
                light(x, y) = static_cast<float>(frame.display_luminance(reflect_unit_irradiance(surface) * *found));
            }
        }
    }
    return {cache.size(), measure_light(light, reference, grid, threshold)};
}

Outcome run_cache(const StudyFrame& frame, RenderSettings settings, double accuracy, const ReferenceLight& reference,
                  const PixelGrid& grid, const Image<float>& threshold) {
    settings.accuracy = accuracy;
    const Image<float> alpha(settings.width, settings.height, static_cast<float>(accuracy));
    const CachedLight light = compute_cached_light(frame, settings, alpha);
    return {light.record_count, measure_light(light.light, reference, grid, threshold)};
}

void compare_frame(const std::string& text, const RadiiOptions& options, const StudyTable& table) {
    const FrameOfScene which = parse_frame_of_scene(text);
    const Scene scene = load_scene(which.file);
    const std::int64_t number = which.frame.value_or(0);
    RenderSettings settings = scene_settings(scene, which.file, options.study.size, {});
    settings.gather = options.study.gather;
    settings.min_radius_pixels = 1.0;
    settings.bounces = 1;
    settings.light_step = 0;
    Sequence viewer = make_vision_sequence(scene, settings, Guide::spatial, Vision::thesis);
    const Image<float> threshold = compute_vision(viewer, number).threshold;
    settings.perception.guide = Guide::none;
    const Sequence sequence(scene, settings);
    const StudyFrame frame(sequence, settings, number);
    const PixelGrid& grid = options.reference.grid;
    const ReferenceLight reference =
        load_or_gather_reference(frame, settings, which.file, options.reference, options.study.quiet);
    const auto add = [&](const char* rule, const std::string& knob, const Outcome& outcome) {
        table.add({fmt::format("{} {}", scene_name(which.file), number), rule, knob, fmt::format("{}", outcome.values),
                   fmt::format("{:.2f}", 1e-6 * static_cast<double>(outcome.values) * settings.gather),
                   fmt::format("{:.1e}", outcome.error.relative_mse - outcome.error.noise_mse),
                   fmt::format("{:.1e}", outcome.error.relative_mse_most - outcome.error.noise_mse),
                   fmt::format("{:+.2f}", 100.0 * outcome.error.bias),
                   fmt::format("{:.2f}", outcome.error.percent_beyond(1.0))});
    };
    const auto sweep = [&](const char* name, Rule rule, const std::vector<std::string>& knobs) {
        for (const std::string& knob : knobs) {
            add(name, knob,
                run_rule(frame, settings, rule, parse_value<double>(knob, name), reference, grid, threshold));
        }
    };
    sweep("split sphere", Rule::sphere, options.sphere);
    sweep("nearest, clamped", Rule::clamped, options.sphere);
    sweep("Hessian", Rule::hessian, options.hessian);
    for (const std::string& accuracy : options.cache) {
        add("error-driven", accuracy,
            run_cache(frame, settings, parse_value<double>(accuracy, "--cache"), reference, grid, threshold));
    }
}

void run_radii(const RadiiOptions& options) {
    const StudyTable table({"frame", "rule", "setting", "values", "M gather rays", "relative MSE", "without .1 %",
                            "bias (%)", "beyond (%)"},
                           3, options.markdown);
    for (const std::string& text : options.frames) compare_frame(text, options, table);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares rules for how far an irradiance value may be used, at equal rays per value and with gradients: the "
        "split sphere (harmonic mean distance), the nearest distance with neighbour clamping, the Hessian of the "
        "irradiance, and the program's own cache. Errors of indirect light against dense gathers."};
    aleph::RadiiOptions options;
    app.add_option("frames", options.frames, "SCENE@FRAME")->required();
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_reference_options(app, options.reference);
    app.add_option("--sphere", options.sphere, "accuracies of both distance rules")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--hessian", options.hessian,
                   "allowed errors of a value over its circle, relative, in squared radii of the scene")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--cache", options.cache, "accuracies of the program's cache")
        ->delimiter(',')
        ->capture_default_str();
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_radii(options); });
}
