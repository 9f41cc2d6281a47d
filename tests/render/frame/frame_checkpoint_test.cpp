// A frame that is stopped anywhere and goes on in another process has the bytes of one that was not.

#include "render/pixels/frame_checkpoint.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct StoppedHere : std::exception {};

struct CheckpointCase {
    std::string name;
    const char* scene;
    std::int64_t frame;
    SettingMap settings;
    double aperture_time = 0.0;  ///< the shutter is open, in frames
};

class FrameCheckpointTest : public testing::TestWithParam<CheckpointCase> {
  protected:
    FrameCheckpointTest() : scene_(load_scene(source_folder() / "scenes" / GetParam().scene)) {
        SettingMap settings = GetParam().settings;
        settings.emplace("size", "40x30");
        apply_settings(settings_, scene_.source.settings, "");
        apply_settings(settings_, settings, "");
        if (GetParam().aperture_time > 0.0) {
            for (Camera& camera : scene_.cameras) camera.shutter = {0.0, GetParam().aperture_time};
        }
    }

    /// The frame's file with all channels, and its rays.
    std::string render(const FrameRequest& request) const {
        Sequence sequence(scene_, settings_);
        const FrameOutput output = sequence.render(GetParam().frame, request);
        const ScratchFolder folder;
        write_exr(folder / "frame.exr", make_frame_image(output, true, scene_, settings_, sequence.exposure()));
        return read_bytes(folder / "frame.exr") + std::to_string(output.statistics.counts.rays.total());
    }

    Scene scene_;
    RenderSettings settings_;
};

TEST_P(FrameCheckpointTest, OU07_StoppedAnywhereItHasTheSameBytes) {
    const ScratchFolder folder;
    const fs::path file = folder / "checkpoint";
    FrameRequest request;
    request.maps = true;
    const std::string expected = render(request);
    int calls = 0, all = 0;
    {  // how often the state could be written
        FrameCheckpoint checkpoint(file, "frame", [&] { return ++all < 0; });
        request.checkpoint = &checkpoint;
        EXPECT_TRUE(render(request) == expected) << "with a checkpoint";
        EXPECT_FALSE(fs::exists(file));
    }
    ASSERT_GT(all, 2);
    int stops = 0;
    for (bool finished = false; !finished; ++stops) {
        // Each process writes after a few pieces of work and is stopped after a few more.
        calls = 0;
        const int limit = 1 + all / 5;
        FrameCheckpoint checkpoint(file, "frame", [&] { return ++calls == limit; });
        request.checkpoint = &checkpoint;
        request.progress = [&](double, const char*) {
            if (calls > limit) throw StoppedHere();
        };
        try {
            EXPECT_TRUE(render(request) == expected) << "after " << stops << " stops";
            finished = true;
        } catch (const StoppedHere&) {
            ASSERT_TRUE(fs::exists(file));
            ASSERT_LT(stops, 50);
        }
    }
    EXPECT_GE(stops, 3) << all << " pieces of work";

    // That of another frame, and a damaged one, are left alone: any frame that is read as if it were new.
    std::string bytes = read_bytes(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    request.progress = {};
    for (const char* identity : {"other frame", "frame"}) {
        FrameCheckpoint checkpoint(file, identity, [] { return false; });
        EXPECT_FALSE(checkpoint.has_gathers()) << identity;
        request.checkpoint = &checkpoint;
        if (GetParam().name == "records") {
            EXPECT_TRUE(render(request) == expected) << identity;
        }
        std::ofstream(file, std::ios::binary) << bytes;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Renders, FrameCheckpointTest,
    testing::Values(
        CheckpointCase{"asked_error", "pool/scene.json", 20, {{"error", 1.0}, {"size", "24x18"}}},
        CheckpointCase{"keyframes", "pool/scene.json", 23, {{"error", 2.0}, {"light_step", 10.0}, {"size", "16x12"}}},
        CheckpointCase{"textures", "boomerang/scene.json", 22, {{"error", 1.0}}},
        CheckpointCase{"records",
                       "cornell/scene.json",
                       3,
                       {{"spp", 3.0}, {"accuracy", 0.2}, {"gather", 64.0}, {"light_step", 0.0}}},
        CheckpointCase{"gathered", "cornell/scene.json", 3, {{"spp", 1.0}, {"accuracy", 0.0}, {"size", "160x120"}}},
        CheckpointCase{"paths", "pool/scene.json", 20, {{"integrator", "path"}, {"spp", 1.0}, {"size", "160x120"}}},
        CheckpointCase{"shutter", "pool/scene.json", 20, {{"error", 4.0}, {"size", "24x18"}}, 0.5}),
    [](const auto& test) { return test.param.name; });

TEST(FrameCheckpoint, OU07_LightThatComesBeforeTheFrameIsKept) {
    RenderSettings keyframes = quick_settings(16, 12), shutter = keyframes;
    keyframes.cache.light_step = 10;
    shutter.cache.light_step = 0;
    shutter.sampling.spp = 16;
    Scene still = pool_scene(), blurred = pool_scene();
    blurred.cameras.front().shutter = {0.0, 1.0};
    add_light(blurred, Light::Kind::point, glm::dvec3(500.0), {0.0, 2.0, 0.0}, z_to_up);
    blurred.nodes.back().transform.translation = Track<glm::dvec3>({0.0, 1.0}, {{-9.0, 2.0, 0.0}, {9.0, 2.0, 0.0}});
    for (const auto& [name, scene, settings] :
         {std::tuple("keyframes", still, keyframes), std::tuple("shutter", blurred, shutter)}) {
        SCOPED_TRACE(name);
        const ScratchFolder folder;
        FrameRequest request;
        bool is_kept = false;
        request.progress = [&](double, const char*) {
            if (is_kept) throw StoppedHere();
        };
        FrameCheckpoint checkpoint(folder / "checkpoint", "frame", [&] { return is_kept = true; });
        request.checkpoint = &checkpoint;
        EXPECT_THROW(Sequence(scene, settings).render(15, request), StoppedHere);
        EXPECT_TRUE(fs::exists(folder / "checkpoint"));
        FrameCheckpoint kept(folder / "checkpoint", "frame", [] { return false; });
        EXPECT_FALSE(kept.has_gathers()) << "of the frame itself";
        EXPECT_TRUE(kept.take_samples().empty());
        const auto finish = [&](FrameCheckpoint* from) {
            return Sequence(scene, settings).render(15, {.checkpoint = from}).shaded.color.pixels;
        };
        EXPECT_TRUE(finish(&kept) == finish(nullptr));
        FrameCheckpoint always(folder / "samples", "frame", [] { return true; });
        EXPECT_TRUE(finish(&always) == finish(nullptr)) << "written among the samples, too";
        FrameCheckpoint samples(folder / "samples", "frame", [] { return false; });
        EXPECT_TRUE(finish(&samples) == finish(nullptr)) << "after the last sample";
    }
}

/// A frame with an open shutter, and glass around which each time looks with a ray of its own. Goes on from the state
/// after its last sample.
TEST(FrameCheckpoint, OU07_SamplesThatWereTakenPoseNothingAgain) {
    Scene scene = pool_scene();
    scene.cameras.front().shutter = {0.0, 0.5};
    scene.materials.back().glass.transmission = 1.0;
    scene.materials.back().glass.thickness = 0.01;
    std::vector<std::uint64_t> traced;
    for (const int spp : {2, 16}) {
        const ScratchFolder folder;
        RenderSettings settings;
        set_size(settings, 8, 6);
        settings.light.integrator = Integrator::path;
        settings.sampling.rule = Sampling::uniform;
        settings.sampling.spp = spp;
        const auto render = [&] {
            FrameCheckpoint checkpoint(folder / "checkpoint", "frame", [] { return true; });
            FrameRequest request;
            request.checkpoint = &checkpoint;
            return Sequence(scene, settings).render(20, request).statistics;
        };
        const FrameStatistics whole = render(), rest = render();
        EXPECT_EQ(rest.counts.rays.total(), whole.counts.rays.total()) << spp;
        EXPECT_LT(rest.traced.all, whole.traced.all) << spp;
        traced.push_back(rest.traced.all);
    }
    EXPECT_EQ(traced[1], traced[0]);
}

TEST(PartialPicture, ShowsAllPixelsSoFar) {
    RenderSettings settings = small_settings();
    set_size(settings, 40, 30);
    settings.sampling.spp = 16;
    Sequence sequence(pool_scene(), settings);
    FrameRequest request;
    int shown = 0;
    request.partial.is_wanted = [&] { return shown == 0; };
    request.partial.show = [&](const Image<Rgb>& color) {
        ++shown;
        ASSERT_EQ(color.size(), 1200u);
        EXPECT_GT(std::ranges::count_if(color.pixels, [](const Rgb& c) { return c.x + c.y + c.z > 0.0f; }), 600);
    };
    sequence.render(20, request);
    EXPECT_EQ(shown, 1);
}

}  // namespace
}  // namespace aleph
