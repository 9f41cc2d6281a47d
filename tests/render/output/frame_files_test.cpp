// Frames as files: their channels, motion to the last bit, statistics that add up.

#include <nlohmann/json.hpp>

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Rendered {
    Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    RenderSettings settings;
    FrameOutput output;
    double exposure = 0.0;

    explicit Rendered(std::int64_t frame) {
        set_size(settings, 48, 36);
        settings.sampling.spp = 1;
        settings.cache.gather = 16;
        settings.light.light_samples = 2;
        settings.cache.light_step = 0;  // the quick estimate is gathered in the frame
        Sequence sequence(scene, settings);
        output = sequence.render(frame, {.maps = true, .progress = {}});
        exposure = sequence.exposure();
    }
    ChannelImage image() const { return make_frame_image(output, true, scene, settings, exposure); }
};

TEST(FrameFiles, HaveEveryChannel) {
    const ChannelImage file = Rendered(10).image();
    std::istringstream names(
        "R G B A forward.u forward.v motion.valid backward.u backward.v backward.valid velocity.image "
        "velocity.retinal saliency.Y conspicuity.intensity conspicuity.color conspicuity.orientation "
        "conspicuity.motion aleph.Y alpha.acc threshold.Y threshold.noise estimate.R estimate.G estimate.B Z "
        "N.X N.Y N.Z objectId.X albedo.R albedo.G albedo.B effects.R effects.G effects.B samples.Y records.Y "
        "cache.count cache.radius invalid.Y");
    for (std::string name; names >> name;) EXPECT_NE(file.find(name), nullptr) << name;
    EXPECT_EQ(file.channels.size(), 44u);
    EXPECT_EQ(std::get<double>(file.metadata.at("whiteLuminance")), 100.0);
    EXPECT_EQ((std::get<std::array<int, 2>>(file.metadata.at("framesPerSecond"))), (std::array<int, 2>{30, 1}));
}

TEST(FrameFiles, MotionInTheFileIsTheFieldToOneUlpWithYUp) {
    const Rendered rendered(10);
    const ScratchFolder folder;
    write_exr(folder / "frame.exr", rendered.image());
    const ChannelImage read = read_image(folder / "frame.exr");
    const Image<float>&u = *read.find("forward.u"), &v = *read.find("forward.v");
    int moving = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const glm::dvec2 d = rendered.output.motion.displacement.pixels[i];
        EXPECT_LE(std::abs(u.pixels[i] - d.x), std::abs(d.x) * 0x1p-24);
        EXPECT_LE(std::abs(v.pixels[i] + d.y), std::abs(d.y) * 0x1p-24);
        EXPECT_FALSE(std::signbit(v.pixels[i]) && v.pixels[i] == 0.0f);
        moving += d != glm::dvec2(0.0);
    }
    EXPECT_GT(moving, 20);
    EXPECT_LT(moving, static_cast<int>(u.size()));
}

/// A square in front of the camera that moves up and right by 1, 3 and 9 pixels in three frames, before a wall.
struct MovingSquare {
    Scene scene;
    RenderSettings settings;

    MovingSquare() {
        const double pixel = 0.1;  // m, at the square's distance
        const ScratchFolder folder;
        const auto at = [&](double pixels) { return fmt::format("[{}, {}, 0]", pixels * pixel, pixels * pixel); };
        std::ofstream(folder / "scene.json")
            << R"({"aleph": 1, "exposure": 1, "frames": [0, 3], "nodes": [
            {"translation": [0, 0, 10], "camera": {"fov": 28.0724869358530}},
            {"translation": [0, 0, 9], "light": {"type": "point", "intensity": 300}},
            {"shape": {"type": "quad", "size": [20, 20]}, "translation": [0, 0, -1]},
            {"shape": {"type": "quad", "size": [1.61, 1.61]}, "translation": {"keys": [[0, )"
            << at(-4) << "], [1, " << at(-3) << "], [2, " << at(0) << "], [3, " << at(9) << "]]}}]}";
        scene = load_scene(folder / "scene.json");
        settings.picture.width = settings.picture.height = 50;  // 5 m at a distance of 10 m
        settings.cache.light_step = 0;
    }
    ChannelImage maps(std::int64_t frame) const {
        Sequence sequence(scene, settings);
        return make_frame_image(sequence.render(frame, {.frame = false, .maps = true, .progress = {}}), true, scene,
                                settings, sequence.exposure());
    }
};

TEST(FrameFiles, MotionHasTheSignsOfOtherPrograms) {
    const MovingSquare square;
    const double steps[] = {1.0, 3.0, 9.0};
    for (int frame = 0; frame <= 3; ++frame) {
        SCOPED_TRACE(frame);
        const ChannelImage file = square.maps(frame);
        const int x = 25 + (frame == 0 ? -4 : frame == 1 ? -3 : frame == 2 ? 0 : 9), y = 49 - x;
        const auto at = [&](const char* name) { return (*file.find(name))(x, y); };
        const double before = steps[std::max(frame - 1, 0)], after = steps[std::min(frame, 2)];
        // Nuke: forward is the next position minus this one, backward the previous minus this one, v upwards.
        EXPECT_NEAR(at("forward.u"), after, 1e-4);
        EXPECT_NEAR(at("forward.v"), after, 1e-4);
        EXPECT_NEAR(at("backward.u"), -before, 1e-4);
        EXPECT_NEAR(at("backward.v"), -before, 1e-4);
        // Blender's Vector: X, Y are the previous position minus this one; Z, W this one minus the next.
        const float vector_x = at("backward.u"), vector_z = -at("forward.u");
        EXPECT_LT(vector_x, 0.0f);
        EXPECT_LT(vector_z, 0.0f);
        EXPECT_EQ(at("backward.valid"), 1.0f);
        EXPECT_EQ((*file.find("backward.u"))(2, 47), 0.0f) << "the wall";
        EXPECT_FALSE(std::signbit((*file.find("backward.v"))(2, 47)));
    }
    // At frame 3 the square has uncovered a part of the wall that it hid at frame 2.
    EXPECT_EQ((*square.maps(3).find("backward.valid"))(25, 24), -4.0f);
    EXPECT_EQ((*square.maps(2).find("motion.valid"))(34, 15), -4.0f) << "and it will hide this";
}

TEST(FrameFiles, ThereIsNoMotionBackAcrossACutNorFromAFrameThatStands) {
    MovingSquare square;
    square.scene.film.cuts = {2};
    const ChannelImage cut = square.maps(2);
    EXPECT_EQ((*cut.find("backward.valid"))(25, 24), -3.0f);
    EXPECT_EQ((*cut.find("backward.u"))(25, 24), 0.0f);
    EXPECT_NE((*cut.find("forward.u"))(25, 24), 0.0f);
    // After the last key nothing moves: frame 4 is the first of those that stand still, and has come from frame 3.
    square.scene.film.cuts.clear();
    square.scene.film.range = FrameRange{0, 9};
    EXPECT_NEAR((*square.maps(3).find("backward.u"))(34, 15), -9.0f, 1e-4);
    EXPECT_EQ((*square.maps(5).find("backward.u"))(34, 15), 0.0f);
    EXPECT_EQ((*square.maps(5).find("backward.valid"))(34, 15), 1.0f);
}

TEST(FrameFiles, GeometryChannelsAgreeWithTheCamera) {
    const Rendered rendered(10);
    const ChannelImage file = rendered.image();
    const CameraView& view = rendered.output.view;
    for (int y = 0; y < view.height; y += 5) {
        for (int x = 0; x < view.width; x += 5) {
            const float z = (*file.find("Z"))(x, y);
            const glm::vec3 n((*file.find("N.X"))(x, y), (*file.find("N.Y"))(x, y), (*file.find("N.Z"))(x, y));
            if ((*file.find("objectId.X"))(x, y) < 0.0f) {
                EXPECT_EQ(z, 1e30f);
                EXPECT_EQ(n, glm::vec3(0.0f));
                EXPECT_EQ((*file.find("motion.valid"))(x, y), 0.0f);
                continue;
            }
            const CameraRay ray = make_camera_ray(view, x + 0.5, y + 0.5);
            const double planar = rendered.output.hits(x, y).distance * glm::dot(ray.direction, -view.axes[2]);
            EXPECT_NEAR(z, planar, 1e-4 * planar);
            EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
            EXPECT_LT(glm::dot(glm::dvec3(n), ray.direction), 0.0);
        }
    }
}

TEST(FrameFiles, StatisticsAddUp) {
    const Rendered rendered(10);
    const auto json = nlohmann::json::parse(format_statistics(format_frame_statistics(rendered.output.statistics),
                                                              rendered.scene, rendered.settings, rendered.exposure));
    const auto& frame = json.at("frames").at(0);
    EXPECT_EQ(frame.at("frame"), 10);
    for (const char* whole : {"spp", "gather", "seed"})
        EXPECT_TRUE(json["settings"][whole].is_number_integer()) << whole;
    for (const char* counts : {"rays", "cache"}) {
        for (const auto& [name, count] : frame.at(counts).items()) EXPECT_TRUE(count.is_number_integer()) << name;
    }
    const auto& rays = frame.at("rays");
    std::uint64_t sum = 0;
    for (const char* kind : {"primary", "shadow", "gather", "glossy", "specular", "path"}) {
        sum += rays.at(kind).get<std::uint64_t>();
    }
    EXPECT_EQ(sum, rays.at("traced").get<std::uint64_t>());
    EXPECT_GT(sum, 48u * 36u);
    // And those of the quick estimate.
    EXPECT_GT(rays.at("gather").get<std::uint64_t>(), 16 * frame.at("cache").at("records").get<std::uint64_t>());
    double stages = 0.0;
    for (const auto& [name, seconds] : frame.at("seconds").items()) {
        if (name != "total") stages += seconds.get<double>();
    }
    EXPECT_LE(stages, 1.01 * frame.at("seconds").at("total").get<double>());
    double records = 0.0;
    for (const float r : rendered.output.shaded.records.pixels) records += r;
    EXPECT_EQ(records, static_cast<double>(rendered.output.statistics.counts.records));
    RenderSettings back;
    SettingMap map;
    for (const auto& [key, value] : json.at("settings").items()) {
        if (value.is_boolean()) map[key] = value.get<bool>();
        if (value.is_number()) map[key] = value.get<double>();
        if (value.is_string()) map[key] = value.get<std::string>();
    }
    apply_settings(back, map, "stats");
    EXPECT_EQ(back, rendered.settings);
}

TEST(FrameFiles, NothingIsPerceivedWithoutAGuideOrMaps) {
    Rendered rendered(10);
    rendered.settings.perception.guide = Guide::none;
    const FrameOutput out = Sequence(rendered.scene, rendered.settings).render(10);
    EXPECT_TRUE(out.estimate.empty());
    EXPECT_TRUE(out.velocity.empty());
    EXPECT_EQ(out.statistics.seconds.perception, 0.0);
    for (const float alpha : out.limits.alpha.pixels)
        EXPECT_EQ(alpha, static_cast<float>(rendered.settings.cache.accuracy));
}

/// Row vector times matrix, divided by w.
glm::dvec3 apply(const Matrix44f& m, const glm::dvec3& point) {
    double sum[4];
    for (int column = 0; column < 4; ++column) {
        sum[column] = point.x * m[column] + point.y * m[4 + column] + point.z * m[8 + column] + m[12 + column];
    }
    return glm::dvec3(sum[0], sum[1], sum[2]) / sum[3];
}

/// OpenEXR's definitions: z forward; x and y from 0 to 1 over the picture, y down.
TEST(FrameFiles, CameraMatricesAreThoseOfTheStandard) {
    const ScratchFolder folder;
    for (const bool orthographic : {false, true}) {
        FrameOutput output;
        output.estimate = Image<Rgb>(8, 4);
        output.view = {.width = 8,
                       .height = 4,
                       .orthographic = orthographic,
                       .position = {3.0, -1.0, 2.0},
                       .axes = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1.0, 2.0, -0.5))),
                       .pixels_per_unit = 5.0,
                       .axis_offset = {0.5, -0.25}};
        write_exr(folder / "f.exr", make_frame_image(output, true, Scene(), RenderSettings(), 1.0));
        const ChannelImage file = read_image(folder / "f.exr");
        const auto& to_view = std::get<Matrix44f>(file.metadata.at("worldToCamera"));
        const auto& to_ndc = std::get<Matrix44f>(file.metadata.at("worldToNDC"));
        for (const glm::dvec3 place : {glm::dvec3(0.4, 0.3, -2.0), {-1.0, 0.2, -5.0}, {0.0, -0.7, -1.0}}) {
            const glm::dvec3 point = output.view.position + output.view.axes * place;
            EXPECT_LT(glm::length(apply(to_view, point) - place * glm::dvec3(1.0, 1.0, -1.0)), 1e-6);
            const glm::dvec2 pixel = project_camera_point(output.view, place);
            const glm::dvec3 ndc = apply(to_ndc, point);
            EXPECT_NEAR(ndc.x, pixel.x / 8.0, 1e-6);
            EXPECT_NEAR(ndc.y, pixel.y / 4.0, 1e-6);
        }
    }
}

}  // namespace
}  // namespace aleph
