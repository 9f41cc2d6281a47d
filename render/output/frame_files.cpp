#include "render/output/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/base/pixel_loops.h"
#include "engine/pose/pose.h"
#include "render/guide/error_report.h"
#include "render/output/channel_table.h"
#include "render/surface/node_paths.h"

namespace aleph {

namespace {

template <class T, class Pick>
Image<float> pick(const Image<T>& image, const Pick& value_of) {
    return map_pixels([&](const T& value) { return static_cast<float>(value_of(value)); }, image);
}

void add(ChannelImage& file, const std::string& name, Image<float> values) {
    if (!values.empty()) file.channels.push_back({name, std::move(values)});
}

std::uint32_t scramble(std::uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// {"name": "8 hexadecimal digits", ...}: the names and the bits of their cryptomatte_id.
/// @param names  each once
std::string cryptomatte_manifest(const std::vector<std::string>& names) {
    std::string manifest = "{";
    for (const std::string& name : names) {
        if (manifest.size() > 1) manifest += ',';
        manifest += nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        manifest += fmt::format(":\"{:08x}\"", std::bit_cast<std::uint32_t>(cryptomatte_id(name)));
    }
    return manifest + '}';
}

/// The object at each pixel's centre, with a coverage of 1.
void add_cryptomatte(ChannelImage& file, const Image<Hit>& hits, const Scene& scene) {
    if (hits.empty()) return;
    constexpr const char* layer = "CryptoObject";
    const NodePaths paths(scene);
    std::vector<std::string> shown;
    std::vector<float> ids;
    for (const Instance& instance : list_instances(scene)) {
        const std::string path = paths[instance.node];
        if (shown.empty() || shown.back() != path) shown.push_back(path);
        ids.push_back(cryptomatte_id(path));
    }
    const auto at = [](const char* part) { return std::string(layer) + "00." + part; };
    add(file, at("r"), pick(hits, [&](const Hit& hit) { return hit.instance == no_index ? 0.0f : ids[hit.instance]; }));
    add(file, at("g"), pick(hits, [](const Hit& hit) { return hit.instance == no_index ? 0.0f : 1.0f; }));
    for (const char* part : {"b", "a"}) add(file, at(part), Image<float>(hits.width, hits.height));
    const std::string prefix = cryptomatte_prefix(layer);
    file.metadata[prefix + "name"] = std::string(layer);
    file.metadata[prefix + "hash"] = std::string("MurmurHash3_32");
    file.metadata[prefix + "conversion"] = std::string("uint32_to_float32");
    file.metadata[prefix + "manifest"] = cryptomatte_manifest(shown);
}

void add_descriptions(ChannelImage& file) {
    for (const ChannelInfo& info : channel_table()) {
        for (const std::string& name : info.names) {
            if (file.find(name) == nullptr) continue;
            file.metadata["channel:" + name] =
                fmt::format("{}; {}; background: {}", info.content, info.range, info.background);
        }
    }
}

void add_motion(ChannelImage& file, const MotionField& motion, const std::string& layer, const std::string& valid) {
    add(file, layer + ".u", pick(motion.displacement, [](const glm::dvec2& d) { return d.x; }));
    // 0 - y: a still pixel is +0 in the file.
    add(file, layer + ".v", pick(motion.displacement, [](const glm::dvec2& d) { return 0.0 - d.y; }));
    add(file, valid, pick(motion.validity, [](MotionValidity v) { return static_cast<int>(v); }));
}

void add_maps(ChannelImage& file, const FrameOutput& output, const Scene& scene) {
    add_motion(file, output.motion, "forward", "motion.valid");
    add_motion(file, output.backward, "backward", "backward.valid");
    add(file, "velocity.image", output.velocity);
    const PerceptionMaps& maps = output.perception;
    add(file, "velocity.retinal", maps.retinal_velocity);
    add(file, "saliency.Y", maps.saliency);
    add(file, "conspicuity.intensity", maps.conspicuity_intensity);
    add(file, "conspicuity.color", maps.conspicuity_color);
    add(file, "conspicuity.orientation", maps.conspicuity_orientation);
    add(file, "conspicuity.motion", maps.conspicuity_motion);
    add(file, "aleph.Y", maps.aleph);
    add(file, "alpha.acc", output.limits.alpha);
    add(file, "threshold.Y", output.limits.threshold);
    add(file, "threshold.noise", output.limits.threshold_noise);
    add_color(file, "estimate.", output.estimate);
    add(file, "Z", output.surface.depth);
    for (int c = 0; c < 3; ++c) {
        add(file, std::string("N.") + "XYZ"[c], pick(output.surface.normal, [c](const glm::vec3& n) { return n[c]; }));
    }
    add(file, "objectId.X", pick(output.hits, [](const Hit& hit) { return hit.instance; }));
    add_cryptomatte(file, output.hits, scene);
    if (!output.surface.albedo.empty()) add_color(file, "albedo.", output.surface.albedo);
    if (!output.surface.effects.empty()) add_color(file, "effects.", output.surface.effects);
    add(file, "samples.Y", output.shaded.samples);
    add(file, "error.Y", output.shaded.errors.total);
    for (std::size_t cause = 0; cause < cause_count; ++cause) {
        add(file, "error." + cause_names()[cause], output.shaded.errors.by_cause[cause]);
    }
    add(file, "records.Y", output.shaded.records);
    add(file, "cache.count", output.shaded.cache_count);
    add(file, "cache.radius", output.shaded.cache_radius);
    add(file, "invalid.Y", output.shaded.invalid_samples);
}

std::string define_motion(const FrameOutput& output, MotionSource source) {
    if (output.motion_from_picture) {
        return "forward.u/.v: position in frame N+1 minus position in frame N, pixels, x right, y up; from the "
               "picture's file";
    }
    const char* what = source == MotionSource::model    ? "of the surface point under the pixel's centre"
                       : source == MotionSource::raster ? "of the surface point, to 8 bits, minus the pixel's centre"
                                                        : "of what looks most like the pixel's neighbourhood";
    return fmt::format(
        "forward.u/.v: position in frame N+1 minus position in frame N {}, pixels, x right, y up; the last frame: N "
        "minus N-1",
        what);
}

/// OpenEXR's standard attribute: to camera axes with z forward (left-handed), m.
glm::dmat4 world_to_camera(const CameraView& view) {
    const glm::dmat3 turn = glm::transpose(view.axes);
    const glm::dmat4 right_handed = glm::translate(glm::dmat4(turn), -view.position);
    return glm::scale(glm::dmat4(1.0), {1.0, 1.0, -1.0}) * right_handed;
}

/// OpenEXR's standard attribute: after division by w, x and y are 0 to 1 over the picture, y down.
glm::dmat4 world_to_ndc(const CameraView& view) {
    const glm::dvec2 size(view.width, view.height), middle = 0.5 * size + view.axis_offset;
    glm::dmat4 project(0.0);  // columns: what x, y, z and 1 of camera axes add
    project[0] = {view.pixels_per_unit / size.x, 0.0, 0.0, 0.0};
    project[1] = {0.0, -view.pixels_per_unit / size.y, 0.0, 0.0};
    const glm::dvec4 offset(middle / size, 0.0, 1.0);
    project[view.orthographic ? 3 : 2] = offset;
    project[view.orthographic ? 2 : 3].z = 1.0;
    return project * world_to_camera(view);
}

/// The columns of a matrix for column vectors are the rows of one for row vectors.
Matrix44f to_attribute(const glm::dmat4& matrix) {
    Matrix44f attribute;
    std::transform(glm::value_ptr(matrix), glm::value_ptr(matrix) + 16, attribute.begin(),
                   [](double value) { return static_cast<float>(value); });
    return attribute;
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    std::uint32_t hash = 0;
    std::size_t at = 0;
    for (; at + 4 <= text.size(); at += 4) {
        std::uint32_t block = 0;
        for (int byte = 3; byte >= 0; --byte) block = block << 8 | static_cast<unsigned char>(text[at + byte]);
        hash = std::rotl(hash ^ scramble(block), 13) * 5u + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t byte = text.size(); byte > at; --byte)
        rest = rest << 8 | static_cast<unsigned char>(text[byte - 1]);
    hash ^= scramble(rest) ^ static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float cryptomatte_id(std::string_view name) {
    std::uint32_t bits = murmur_hash(name);
    const std::uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
    return std::bit_cast<float>(bits);
}

std::string cryptomatte_prefix(std::string_view layer) {
    return fmt::format("cryptomatte/{}/", fmt::format("{:08x}", murmur_hash(layer)).substr(0, 7));
}

Image<float> make_importance(const Image<float>& aleph) {
    return pick(aleph, [](float elevation) { return 1.0f / elevation; });
}

void add_color(ChannelImage& file, const std::string& prefix, const Image<Rgb>& color) {
    for (int c = 0; c < 3; ++c) {
        add(file, prefix + "RGB"[c], pick(color, [c](const Rgb& v) { return v[c]; }));
    }
}

ChannelImage make_color_image(const Image<Rgb>& color) {
    ChannelImage file;
    add_color(file, "", color);
    return file;
}

std::optional<PictureArea> find_whole(const FrameOutput& output) {
    const std::optional<PictureArea>& window = output.statistics.window;
    if (!window) return std::nullopt;
    return PictureArea{-window->x, -window->y, output.view.width, output.view.height};
}

ChannelImage make_frame_image(const FrameOutput& output, bool maps, const Scene& scene, const RenderSettings& settings,
                              double exposure) {
    ChannelImage file;
    if (!output.shaded.color.empty()) {
        add_color(file, "", output.shaded.color);
        add(file, "A", output.shaded.coverage);
        add(file, "variance.Y", output.shaded.variance);
    }
    if (maps) add_maps(file, output, scene);
    file.whole = find_whole(output);
    add_descriptions(file);
    file.metadata["software"] = "aleph " ALEPH_VERSION;
    file.metadata["framesPerSecond"] = std::array<int, 2>{static_cast<int>(scene.film.frame_rate.numerator),
                                                          static_cast<int>(scene.film.frame_rate.denominator)};
    file.metadata["frame"] = static_cast<double>(output.statistics.frame);
    file.metadata["whiteLuminance"] = scene.film.viewing.display_white;
    file.metadata["pixelsPerDegree"] = scene.film.viewing.pixels_per_degree;
    file.metadata["displayPersistence"] = scene.film.viewing.persistence;
    file.metadata["exposureFactor"] = exposure;
    if (output.view.width > 0) {  // pictures that were not rendered here have no camera and no samples
        const Image<float>& samples = output.shaded.samples;
        const double taken = std::accumulate(samples.pixels.begin(), samples.pixels.end(), 0.0);
        file.metadata["samplesPerPixel"] = samples.empty() ? 0.0 : taken / static_cast<double>(samples.size());
        file.metadata["seed"] = static_cast<double>(settings.seed);
        file.metadata["worldToCamera"] = to_attribute(world_to_camera(output.view));
        file.metadata["worldToNDC"] = to_attribute(world_to_ndc(output.view));
    }
    file.metadata["motion:definition"] = define_motion(output, settings.guide.motion);
    for (const auto& [key, value] : setting_map(settings)) file.metadata["aleph:" + key] = setting_text(value);
    return file;
}

}  // namespace aleph
