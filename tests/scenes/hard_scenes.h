#pragma once
// The scenes of scenes/hard, rendered at 48x36.

#include "engine/base/color.h"
#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {

inline std::filesystem::path hard_scenes_folder() {
    return source_folder() / "scenes" / "hard";
}

inline RenderSettings small_settings() {
    return quick_settings(48, 36);
}

/// The height of the picture at distance 1 spans 40 degrees.
inline const double pixels_per_unit = 18.0 / std::tan(20.0 * pi / 180.0);

inline FrameOutput render_hard(Sequence& sequence, std::int64_t frame) {
    return sequence.render(frame, {.frame = true, .maps = true, .progress = {}});
}
inline FrameOutput render_hard(const Scene& scene, std::int64_t frame) {
    Sequence sequence(scene, small_settings());
    return render_hard(sequence, frame);
}

/// A scene of the folder with its sequence.
struct HardScene {
    explicit HardScene(const std::string& name)
        : scene(load_scene(hard_scenes_folder() / (name + ".json"))), sequence(scene, small_settings()) {}
    FrameOutput render(std::int64_t frame) { return render_hard(sequence, frame); }
    int node(const std::string& name) const { return find_named(scene.nodes, name); }
    ScenePose posed(double frame) const { return pose(scene, frame / scene.film.frame_rate.per_second()); }
    glm::dmat4 world(const std::string& name, double frame) const { return posed(frame).world[node(name)]; }
    /// Pixels whose first hit is on the node called `name`.
    std::vector<std::size_t> pixels_on(const FrameOutput& output, const std::string& name) const {
        const std::vector<Instance> instances = list_instances(scene);
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < output.hits.size(); ++i) {
            const int instance = output.hits.pixels[i].instance;
            if (instance != no_index && instances[instance].node == node(name)) pixels.push_back(i);
        }
        return pixels;
    }
    /// The same where there must be some.
    std::vector<std::size_t> seen_on(const FrameOutput& output, const std::string& name) const {
        std::vector<std::size_t> pixels = pixels_on(output, name);
        EXPECT_FALSE(pixels.empty()) << name;
        return pixels;
    }

    Scene scene;
    Sequence sequence;
};

inline double mean_luminance(const Image<Rgb>& image) {
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) sum += luminance(pixel);
    return sum / static_cast<double>(image.size());
}

inline double longest_motion(const FrameOutput& output) {
    double longest = 0.0;
    for (const glm::dvec2& d : output.motion.displacement.pixels) longest = std::max(longest, glm::length(d));
    return longest;
}

}  // namespace aleph
