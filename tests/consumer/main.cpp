// A small program outside the repository. It makes an animated scene, renders one frame and checks values that can
// be computed by hand: a pixel, a motion vector, an Aleph value, the errors of a study.

#include <aleph/aleph.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/scene/scene.h"  // own/engine/scene/scene.h: this program's, not aleph's

namespace {

constexpr int width = own_picture.width, height = own_picture.height;
constexpr double distance = 2.0;  // m, from the camera to the wall
constexpr double step = 5.0;      // m a frame, to the right and half of it up

/// A wall that glows evenly, slides sideways and fills the picture at all times.
aleph::Scene make_scene() {
    aleph::Scene scene;
    scene.source.name = "sliding wall";
    scene.film.range = aleph::FrameRange{0, 10};
    scene.film.exposure = 1.0;

    aleph::Material glow;
    glow.name = "glow";
    glow.base_color = glm::dvec3(0.0);
    glow.gloss.specular = 0.0;
    glow.glow.color = glm::dvec3(0.25, 0.5, 0.125);
    scene.materials.push_back(glow);

    aleph::Shape quad;
    quad.kind = aleph::Shape::Kind::quad;
    quad.size = {200.0, 100.0, 1.0};
    scene.meshes.push_back(aleph::make_shape_mesh(quad, 0, "wall"));

    aleph::Node wall;
    wall.name = "wall";
    wall.meshes = {0};
    wall.transform.translation =
        aleph::Track<glm::dvec3>({0.0, 10.0 / 30.0}, {{0.0, 0.0, -distance}, {10.0 * step, 5.0 * step, -distance}});
    scene.nodes.push_back(wall);

    aleph::Camera camera;
    camera.name = "camera";
    camera.fov = std::numbers::pi / 2.0;
    scene.cameras.push_back(camera);
    aleph::Node eye;
    eye.name = "eye";
    eye.camera = 0;
    scene.nodes.push_back(eye);
    return scene;
}

/// Contrast sensitivity, 1 / (least contrast that is seen), for a grating of `frequency` cycles per degree that drifts
/// over the retina at `velocity` deg/s: Yee 2000, eq. 5.7.
double contrast_sensitivity(double frequency, double velocity) {
    constexpr double c0 = 1.14, c1 = 0.67, c2 = 1.7, pi = std::numbers::pi;
    const double k = 6.1 + 7.3 * std::pow(std::abs(std::log10(c2 * velocity / 3.0)), 3.0);
    const double highest = 45.9 / (c2 * velocity + 2.0);
    return k * c0 * c2 * velocity * std::pow(2.0 * pi * frequency * c1, 2.0) *
           std::exp(-4.0 * pi * c1 * frequency / highest);
}

int failures = 0;

void expect_near(const char* what, double found, double expected, double tolerance) {
    const bool good = std::abs(found - expected) <= tolerance;
    std::printf("%-6s %-28s %.9g, expected %.9g +- %g\n", good ? "ok" : "WRONG", what, found, expected, tolerance);
    if (!good) ++failures;
}

}  // namespace

int main() {
    const aleph::Scene scene = make_scene();
    aleph::RenderSettings settings;
    settings.picture.width = width;
    settings.picture.height = height;
    settings.sampling.spp = 1;
    settings.cache.gather = 16;
    settings.perception.guide = aleph::Guide::full;  // the model of motion and contrast, without attention
    aleph::Sequence sequence(scene, settings);
    const aleph::FrameOutput output = sequence.render(3, {.frame = true, .maps = true});

    // A Lambert surface of albedo 0 shows its emission.
    const aleph::Rgb pixel = output.shaded.color(40, 30);
    expect_near("red of a pixel", pixel.r, 0.25, 1e-6);
    expect_near("green of a pixel", pixel.g, 0.5, 1e-6);

    // With a vertical field of view of 90 degrees, half the height is as long as the distance. y points down here.
    const double pixels_per_metre = 0.5 * height / distance;
    const glm::dvec2 motion = output.motion.displacement(40, 30);
    expect_near("motion to the right, px", motion.x, step * pixels_per_metre, 1e-9);
    expect_near("motion down, px", motion.y, -0.5 * step * pixels_per_metre, 1e-9);

    // One colour everywhere: all energy lies in the lowest band, .25 cycles per degree. The eye follows motion of up to
    // 80 deg/s. The elevation is the best sensitivity at the remaining speed over that at .25 (Yee 2000, 5.5 to 5.11).
    const double speed =
        std::hypot(motion.x, motion.y) * scene.film.frame_rate.per_second() / scene.film.viewing.pixels_per_degree;
    const double velocity = speed - std::min(0.82 * speed + 0.15, 80.0);
    const double peak = 45.9 / (1.7 * velocity + 2.0) / (2.0 * std::numbers::pi * 0.67);
    const double elevation = contrast_sensitivity(peak, velocity) / std::max(contrast_sensitivity(0.25, velocity), 1.0);
    expect_near("aleph of the wall", output.perception.aleph(40, 30), elevation, 1e-3 * elevation);

    // The instrument sees nothing in a picture beside itself, and stripes that are beside them.
    const aleph::ChannelImage maps = aleph::make_frame_image(output, true, scene, settings, sequence.exposure());
    const aleph::Image<aleph::Rgb>& plain = output.shaded.color;
    aleph::Image<aleph::Rgb> striped = plain;
    for (std::size_t i = 0; i < striped.size(); ++i) striped.pixels[i] *= i / 4 % 2 == 0 ? 2.0f : 1.0f;
    const auto seen = [&](const aleph::Image<aleph::Rgb>& picture) {
        aleph::SequenceComparison comparison({});
        comparison.add(3, aleph::make_color_image(picture), aleph::make_color_image(plain), {.visible = &maps});
        comparison.finish();
        return comparison.summary().visible->seen;
    };
    expect_near("seen in the same picture, %", seen(plain), 0.0, 0.0);
    expect_near("seen in stripes, %", seen(striped), 100.0, 0.0);

    // A study of the same wall from a file: what shows its emission has no noise.
    aleph::save_scene(scene, "wall.json");
    constexpr const char* study = R"({"scenes": [{"scene": "wall.json", "frames": "3"}], "size": "16x12",
        "reference": {"passes": 2, "spp": 2}, "sweep": {"spp": [1, 2]}, "metrics": ["samples", "share_beyond"]})";
    const aleph::StudyResults results =
        aleph::run_study(aleph::prepare_study(aleph::parse_study(study, "study.json")), "wall-study");
    expect_near("variants of a study", static_cast<double>(results.variants.size()), 2.0, 0.0);
    expect_near("samples of the second", results.variants.at(1).metrics.at("samples").value, 2.0, 0.0);
    expect_near("its visible errors, %", results.variants.at(1).metrics.at("share_beyond").value, 0.0, 0.0);
    return failures == 0 ? 0 : 1;
}
