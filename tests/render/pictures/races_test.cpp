// Work of several threads at once (DT-08). tests/sanitizers.sh thread runs these tests under ThreadSanitizer; otherwise
// they compare the results with those of one thread.

#include "tests/support/frame_bytes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

RenderSettings tiny_settings() {
    RenderSettings settings = small_settings();
    set_size(settings, 64, 48);
    settings.cache.gather = 16;
    return settings;
}

TEST(Races, DT08_EveryStageOfAFrameWithItsCache) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = tiny_settings();
    EXPECT_TRUE(frame_bytes(4, scene, settings, {20, 21}) == frame_bytes(1, scene, settings, {20, 21}));
}

/// Light of lighting keyframes, of two bounces, read while the shutter is open: by the cache, and by paths.
TEST(Races, DT01_DT08_KeyMomentsAndAnOpenShutter) {
    Scene scene = make_shot_with_mover();
    scene.cameras[0].shutter = {-0.5, 0.5};
    RenderSettings settings = tiny_settings();
    set_size(settings, 32, 24);
    settings.cache.light_step = 5;
    settings.light.bounces = 2;
    for (const Integrator integrator : {Integrator::cache, Integrator::path}) {
        settings.light.integrator = integrator;
        EXPECT_TRUE(frame_bytes(4, scene, settings, {3, 7}) == frame_bytes(1, scene, settings, {3, 7}));
        EXPECT_TRUE(frame_bytes(2, scene, settings, {9, 3}).back() == frame_bytes(1, scene, settings, {3}).back());
    }
}

TEST(Races, DT08_SequencesSideBySide) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = tiny_settings();
    const auto render = [&](std::int64_t frame) {
        Sequence sequence(scene, settings);
        return frame_bytes(sequence, scene, settings, frame);
    };
    const std::string alone[2] = {render(20), render(50)};
    std::string together[2];
    with_threads(
        4, [&] { parallel_for(2, 1, [&](std::size_t i, std::size_t) { together[i] = render(i == 0 ? 20 : 50); }); });
    EXPECT_TRUE(together[0] == alone[0]);
    EXPECT_TRUE(together[1] == alone[1]);
}

ChannelImage make_picture(std::size_t index) {
    ChannelImage image;
    for (const char* name : {"R", "G", "B"}) {
        Image<float> values(50, 40);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values.pixels[i] = static_cast<float>((i * 7 + index * 13 + image.channels.size()) % 256) / 255.0f;
        }
        image.channels.push_back({name, values});
    }
    image.metadata["frame"] = static_cast<double>(index);
    return image;
}

TEST(Races, DT08_PicturesWrittenAndReadAtOnce) {
    const ScratchFolder folder;
    write_exr(folder / "shared.exr", make_picture(99));
    constexpr std::size_t count = 24;
    std::vector<ChannelImage> back(count), shared(count);
    std::vector<Image<glm::u8vec4>> decoded(count);
    with_threads(4, [&] {
        parallel_for(count, 1, [&](std::size_t i, std::size_t) {
            const ChannelImage picture = make_picture(i);
            const std::string name = std::to_string(i);
            write_exr(folder / (name + ".exr"), picture);
            back[i] = read_image(folder / (name + ".exr"));
            shared[i] = read_image(folder / "shared.exr");
            Image<Rgb> color(50, 40);
            for (std::size_t k = 0; k < color.size(); ++k) color.pixels[k] = Rgb(picture.channels[0].values.pixels[k]);
            write_png(folder / (name + ".png"), color);
            const std::string bytes = read_bytes(folder / (name + ".png"));
            decoded[i] = decode_texture({bytes.begin(), bytes.end()}, name).bytes;
        });
    });
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(std::get<double>(back[i].metadata.at("frame")), static_cast<double>(i));
        for (const Channel& channel : make_picture(i).channels) {
            ASSERT_NE(back[i].find(channel.name), nullptr);
            EXPECT_TRUE(back[i].find(channel.name)->pixels == channel.values.pixels) << i << channel.name;
        }
        EXPECT_TRUE(shared[i].find("G")->pixels == make_picture(99).channels[1].values.pixels) << i;
        ASSERT_EQ(decoded[i].size(), 2000u);
        const auto grey = decoded[i].pixels[0];
        EXPECT_TRUE(grey[0] == grey[1] && grey[1] == grey[2] && grey[3] == 255) << i;
        EXPECT_EQ(grey[0] == 0, i == 0) << i;  // sRGB of (13 i mod 256) / 255
    }
}

}  // namespace
}  // namespace aleph
