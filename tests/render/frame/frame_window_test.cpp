// A window of a frame: what of it is that of the whole picture.

#include "render/frame/frame_window.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/moving_box.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr PictureArea window{9, 7, 14, 11};

RenderSettings window_settings() {
    RenderSettings settings = quick_settings(40, 30);
    settings.sampling.spp = 4;
    return settings;
}

FrameOutput render_window(Sequence& sequence, std::optional<PictureArea> area, std::int64_t frame = 10) {
    FrameRequest request{.maps = true, .progress = {}};
    request.window = area;
    return sequence.render(frame, request);
}

FrameOutput render_window(const RenderSettings& settings, std::optional<PictureArea> area) {
    Sequence sequence(make_moving_scene(), settings);
    return render_window(sequence, area);
}

void expect_cut(const char* name, const auto& image, const auto& of_window) {
    ASSERT_FALSE(image.empty()) << name;
    EXPECT_TRUE(crop(image, window).pixels == of_window.pixels) << name;
    EXPECT_EQ(of_window.width, window.width) << name;
}

TEST(FrameWindow, HasTheMapsOfTheWholePicture) {
    RenderSettings settings = window_settings();
    settings.perception.guide = Guide::saliency;
    const FrameOutput whole = render_window(settings, std::nullopt), part = render_window(settings, window);
    EXPECT_EQ(part.statistics.window, window);
    EXPECT_EQ(part.view.width, 40);
    expect_cut("estimate", whole.estimate, part.estimate);
    expect_cut("motion", whole.motion.displacement, part.motion.displacement);
    expect_cut("backward", whole.backward.validity, part.backward.validity);
    expect_cut("aleph", whole.perception.aleph, part.perception.aleph);
    expect_cut("saliency", whole.perception.saliency, part.perception.saliency);
    expect_cut("threshold", whole.limits.threshold, part.limits.threshold);
    expect_cut("noise", whole.limits.threshold_noise, part.limits.threshold_noise);
    expect_cut("accuracy", whole.limits.alpha, part.limits.alpha);
    expect_cut("depth", whole.surface.depth, part.surface.depth);
    expect_cut("albedo", whole.surface.albedo, part.surface.albedo);
}

TEST(FrameWindow, HasThePixelsOfTheWholePictureWhereTheyShareNoRecords) {
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        for (const Sampling rule : {Sampling::uniform, Sampling::protocol}) {
            RenderSettings settings = window_settings();
            settings.light.integrator = integrator;
            settings.light.bounces = 3;
            settings.cache.accuracy = 0.0;
            settings.sampling.rule = integrator == Integrator::path ? Sampling::uniform : rule;
            const FrameOutput whole = render_window(settings, std::nullopt), part = render_window(settings, window);
            SCOPED_TRACE(testing::Message() << static_cast<int>(integrator) << ' ' << static_cast<int>(rule));
            expect_cut("color", whole.shaded.color, part.shaded.color);
            expect_cut("coverage", whole.shaded.coverage, part.shaded.coverage);
            expect_cut("samples", whole.shaded.samples, part.shaded.samples);
            EXPECT_LT(part.statistics.counts.samples, whole.statistics.counts.samples / 3);
        }
    }
}

TEST(FrameWindow, TakesSamplesAndRecordsForItsOwnPixelsAlone) {
    RenderSettings settings = window_settings();
    follow_error(settings, 2.0);
    const auto mean = [](const Image<Rgb>& image) {
        double sum = 0.0;
        for (const Rgb& color : image.pixels) sum += luminance(color);
        return sum / static_cast<double>(image.size());
    };
    const FrameOutput whole = render_window(settings, std::nullopt), part = render_window(settings, window);
    EXPECT_NEAR(mean(part.shaded.color) / mean(crop(whole.shaded.color, window)), 1.0, 0.02);
    ASSERT_TRUE(part.statistics.error.has_value());
    EXPECT_EQ(part.shaded.errors.total.width, window.width);
    const FrameOutput corner = render_window(settings, PictureArea{0, 0, 8, 6});  // 16x14 with what its pixels read
    EXPECT_LT(corner.statistics.counts.samples, whole.statistics.counts.samples / 2);
    EXPECT_LT(corner.statistics.counts.records, std::max<std::uint64_t>(1, whole.statistics.counts.records));
}

TEST(FrameWindow, IsRefusedWhereItIsNotWithinThePicture) {
    Sequence sequence(make_moving_scene(), window_settings());
    for (const PictureArea& bad :
         {PictureArea{0, 0, 0, 5}, PictureArea{0, 0, 5, -1}, PictureArea{-1, 0, 5, 5}, PictureArea{36, 0, 5, 5},
          PictureArea{0, 26, 5, 5}, PictureArea{2000000000, 0, 2000000000, 5}})
        EXPECT_EQ(find_refusal([&] { render_window(sequence, bad); }).place, "window") << bad.x;
    EXPECT_NO_THROW(render_window(sequence, PictureArea{39, 29, 1, 1}));
}

TEST(FrameWindow, OfAStaticSpanIsNoCopyOfAnother) {
    Scene scene = make_moving_scene();
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.5, 0.0);
    Sequence sequence(scene, window_settings());
    const FrameOutput first = render_window(sequence, window, 3);
    const FrameOutput moved = render_window(sequence, PictureArea{0, 0, 14, 11}, 4);
    EXPECT_FALSE(first.estimate.pixels == moved.estimate.pixels);
    EXPECT_TRUE(render_window(sequence, PictureArea{0, 0, 14, 11}, 5).estimate.pixels == moved.estimate.pixels);
}

}  // namespace
}  // namespace aleph
