// Time of a texture look-up in one thread, at a point and over footprints of growing length, and of making a footprint.

#include <benchmark/benchmark.h>

#include <array>
#include <random>

#include "render/surface/texture_footprint.h"

namespace aleph {
namespace {

struct LookUps {
    explicit LookUps(bool bytes) {
        std::mt19937 random(1);
        if (bytes) {
            image.bytes = Image<glm::u8vec4>(512, 512);
            for (glm::u8vec4& texel : image.bytes.pixels) texel = glm::u8vec4(random());
        } else {
            image.floats = Image<glm::vec4>(512, 512, glm::vec4(0.5f));
        }
        set.textures.push_back(make_texture(image, TextureSpace::srgb));
        use = make_texture_use({.image = 0}, 0);
        std::uniform_real_distribution<float> anywhere(-2.0f, 2.0f);
        for (glm::vec2& uv : places) uv = {anywhere(random), anywhere(random)};
    }
    SceneImage image;
    TextureSet set;
    TextureUse use;
    std::array<glm::vec2, 1024> places;
};

/// Arguments: texels along the footprint and across it; round or not.
void look_up(benchmark::State& state) {
    const LookUps data(true);
    const float length = static_cast<float>(state.range(0)) / 512.0f,
                width = static_cast<float>(state.range(1)) / 512.0f;
    const UvFootprint footprint{{0.8f * length, 0.6f * length}, {-0.6f * width, 0.8f * width}, state.range(2) != 0};
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(sample_texture(data.set, data.use, data.places[i++ % 1024], footprint));
    }
}
BENCHMARK(look_up)
    ->ArgNames({"along", "across", "round"})
    ->Args({0, 0, 0})
    ->Args({4, 4, 0})
    ->Args({4, 1, 0})
    ->Args({12, 3, 0})
    ->Args({64, 2, 0})
    ->Args({4, 4, 1})
    ->Args({100, 100, 1});

void pixel_footprint(benchmark::State& state) {
    CameraView view{.pixels_per_unit = 300.0};
    SurfacePoint point;
    point.geometric = {0.0f, 0.6f, 0.8f};
    point.edges[0] = {1.0f, 0.0f, 0.0f};
    point.edges[1] = {0.0f, 0.8f, -0.6f};
    point.uv_edges[0][0] = {1.0f, 0.0f};
    point.uv_edges[0][1] = {0.0f, 1.0f};
    glm::vec3 direction(0.1f, 0.2f, -0.97f);
    for (auto _ : state) {
        benchmark::DoNotOptimize(direction);
        benchmark::DoNotOptimize(make_uv_footprint(point, make_pixel_footprint(view, point, direction, 5.0f, 0.5f), 0));
    }
}
BENCHMARK(pixel_footprint);

}  // namespace
}  // namespace aleph

BENCHMARK_MAIN();
