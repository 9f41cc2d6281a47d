// Time of a texture look-up in one thread, at a point and over footprints of growing length, and of making a footprint.

#include <fmt/format.h>

#include <array>
#include <random>

#include "render/surface/texture_footprint.h"
#include "tests/benchmarks/thread_seconds.h"

namespace aleph {
namespace {

constexpr int calls = 1 << 18;

/// @param call  is given its number, and returns a value, so that it is not left out
template <class Call>
void measure(const std::string& name, const Call& call) {
    Best best(CLOCK_THREAD_CPUTIME_ID);
    volatile float sum = 0.0f;
    for (int round = 0; round < 9; ++round) {
        best.time(
            [&] {
                float found = 0.0f;
                for (int i = 0; i < calls; ++i) found += call(i);
                sum = sum + found;
            },
            calls);
    }
    fmt::print("{:<44}{:>8.1f} ns\n", name, 1e9 * best.least);
}

void run() {
    std::mt19937 random(1);
    SceneImage image{.bytes = Image<glm::u8vec4>(512, 512)};
    for (glm::u8vec4& texel : image.bytes.pixels) texel = glm::u8vec4(random());
    TextureSet set;
    set.textures.push_back(make_texture(image, TextureSpace::srgb));
    const TextureUse use = make_texture_use({.image = 0}, 0);
    std::uniform_real_distribution<float> anywhere(-2.0f, 2.0f);
    std::array<glm::vec2, 1024> places;
    for (glm::vec2& uv : places) uv = {anywhere(random), anywhere(random)};
    const struct {
        float along, across;  // texels
        bool round;
    } footprints[] = {{0, 0, false},  {4, 4, false}, {4, 1, false},   {12, 3, false},
                      {64, 2, false}, {4, 4, true},  {100, 100, true}};
    for (const auto& [along, across, round] : footprints) {
        const float length = along / 512.0f, width = across / 512.0f;
        const UvFootprint footprint{{0.8f * length, 0.6f * length}, {-0.6f * width, 0.8f * width}, round};
        measure(fmt::format("look-up, {} by {} texels{}", along, across, round ? ", round" : ""),
                [&](int i) { return sample_texture(set, use, places[i % 1024], footprint).x; });
    }
    const CameraView view{.pixels_per_unit = 300.0};
    SurfacePoint point;
    point.geometric = {0.0f, 0.6f, 0.8f};
    point.edges[0] = {1.0f, 0.0f, 0.0f};
    point.edges[1] = {0.0f, 0.8f, -0.6f};
    point.uv_edges[0][0] = {1.0f, 0.0f};
    point.uv_edges[0][1] = {0.0f, 1.0f};
    measure("footprint of a pixel", [&](int i) {
        const glm::vec3 direction(1e-6f * static_cast<float>(i), 0.2f, -0.97f);
        return make_uv_footprint(point, make_pixel_footprint(view, point, direction, 5.0f, 0.5f), 0).dx.x;
    });
}

}  // namespace
}  // namespace aleph

int main() {
    aleph::run();
}
