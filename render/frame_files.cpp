#include "render/frame_files.h"

#include <fmt/format.h>

#include <numeric>

#include "engine/base/errors.h"

namespace aleph {

namespace {

template <class T, class Pick>
Image<float> pick(const Image<T>& image, const Pick& value_of) {
    Image<float> out(image.width, image.height);
    for (std::size_t i = 0; i < out.size(); ++i) out.pixels[i] = static_cast<float>(value_of(image.pixels[i]));
    return out;
}

void add(ChannelImage& file, const std::string& name, Image<float> values) {
    if (!values.empty()) file.channels.push_back({name, std::move(values)});
}

void add_color(ChannelImage& file, const std::string& prefix, const Image<Rgb>& color) {
    for (int c = 0; c < 3; ++c) {
        add(file, prefix + "RGB"[c], pick(color, [c](const Rgb& v) { return v[c]; }));
    }
}

void add_maps(ChannelImage& file, const FrameOutput& output) {
    const MotionField& motion = output.motion;
    add(file, "forward.u", pick(motion.displacement, [](const glm::dvec2& d) { return d.x; }));
    // 0 - y: a still pixel is +0 in the file.
    add(file, "forward.v", pick(motion.displacement, [](const glm::dvec2& d) { return 0.0 - d.y; }));
    add(file, "motion.valid", pick(motion.validity, [](MotionValidity v) { return static_cast<int>(v); }));
    add(file, "velocity.image", output.velocity);
    const PerceptionMaps& maps = output.perception;
    add(file, "velocity.retinal", maps.retinal_velocity);
    add(file, "saliency.Y", maps.saliency);
    add(file, "conspicuity.intensity", maps.conspicuity_intensity);
    add(file, "conspicuity.color", maps.conspicuity_color);
    add(file, "conspicuity.orientation", maps.conspicuity_orientation);
    add(file, "conspicuity.motion", maps.conspicuity_motion);
    add(file, "aleph.Y", maps.aleph);
    add(file, "alpha.acc", output.alpha);
    add(file, "threshold.Y", output.threshold);
    add(file, "threshold.flicker", output.threshold_flicker);
    add_color(file, "estimate.", output.estimate);
    add(file, "Z", output.depth);
    for (int c = 0; c < 3; ++c) {
        add(file, std::string("N.") + "XYZ"[c], pick(output.normal, [c](const glm::vec3& n) { return n[c]; }));
    }
    add(file, "objectId.X", pick(output.hits, [](const Hit& hit) { return hit.instance; }));
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
               "picture's "
               "file";
    }
    const char* what = source == MotionSource::model ? "of the surface point under the pixel's centre"
                                                     : "of what looks most like the pixel's neighbourhood";
    return fmt::format(
        "forward.u/.v: position in frame N+1 minus position in frame N {}, pixels, x right, y up; the last frame: N "
        "minus N-1",
        what);
}

std::string format_camera(const CameraView& view) {
    std::string text;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) text += fmt::format("{} ", view.axes[row][column]);
        text += fmt::format("{} ", -glm::dot(view.axes[row], view.position));
    }
    return text + "0 0 0 1";
}

}  // namespace

ChannelImage make_frame_image(const FrameOutput& output, bool maps, const Scene& scene, const RenderSettings& settings,
                              double exposure) {
    ChannelImage file;
    if (!output.shaded.color.empty()) {
        add_color(file, "", output.shaded.color);
        add(file, "A", output.shaded.coverage);
        add(file, "variance.Y", output.shaded.variance);
    }
    if (maps) add_maps(file, output);
    file.metadata["software"] = "aleph " ALEPH_VERSION;
    file.metadata["framesPerSecond"] = std::array<int, 2>{static_cast<int>(scene.frame_rate.numerator),
                                                          static_cast<int>(scene.frame_rate.denominator)};
    file.metadata["frame"] = static_cast<double>(output.statistics.frame);
    file.metadata["whiteLuminance"] = scene.viewing.display_white;
    file.metadata["pixelsPerDegree"] = scene.viewing.pixels_per_degree;
    file.metadata["displayPersistence"] = scene.viewing.persistence;
    file.metadata["exposureFactor"] = exposure;
    if (output.view.width > 0) {  // pictures that were not rendered here have no camera and no samples
        const Image<float>& samples = output.shaded.samples;
        const double taken = std::accumulate(samples.pixels.begin(), samples.pixels.end(), 0.0);
        file.metadata["samplesPerPixel"] = samples.empty() ? 0.0 : taken / static_cast<double>(samples.size());
        file.metadata["seed"] = static_cast<double>(settings.seed);
        file.metadata["worldToCamera"] = format_camera(output.view);
    }
    file.metadata["motion:definition"] = define_motion(output, settings.motion);
    for (const auto& [key, value] : setting_map(settings)) {
        const std::string text = std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
        file.metadata["aleph:" + key] = text;
    }
    return file;
}

}  // namespace aleph
