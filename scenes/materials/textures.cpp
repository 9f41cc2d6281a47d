#include "scenes/materials/textures.h"

#include <cmath>
#include <numbers>

#include "engine/base/color.h"
#include "engine/image/image_file.h"
#include "scenes/common/generator.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

constexpr int size = 256;
constexpr double rows = 8.0, columns = 4.0, joint = 0.07;  // bricks; width of the joints as a share of a brick's height

/// Place within its brick, and which brick.
struct BrickPlace {
    glm::dvec2 edge;  ///< distance to the nearest sides, in heights of a brick
    glm::i64vec2 brick;
};

BrickPlace find_brick(const glm::dvec2& uv) {
    const double row = std::floor(uv.y * rows);
    const double shifted = uv.x * columns + (std::fmod(row, 2.0) == 0.0 ? 0.0 : 0.5);
    const glm::dvec2 inside(shifted - std::floor(shifted), uv.y * rows - row);
    const double aspect = rows / columns;  // width over height
    return {{std::min(inside.x, 1.0 - inside.x) * aspect, std::min(inside.y, 1.0 - inside.y)},
            {static_cast<std::int64_t>(std::floor(shifted)) % static_cast<std::int64_t>(columns),
             static_cast<std::int64_t>(row)}};
}

/// Height in heights of a brick: rounded bricks with a rough face over flat joints.
double brick_height(const glm::dvec2& given) {
    const glm::dvec2 uv = given - glm::floor(given);
    const BrickPlace place = find_brick(uv);
    const double face = glm::smoothstep(joint * 0.5, joint * 1.6, std::min(place.edge.x, place.edge.y));
    const double rough = fractal_noise(uv, {24, 24}, 4, 5);
    return 0.12 * face * (0.8 + 0.2 * rough) + 0.015 * rough;
}

glm::dvec3 brick_color(const glm::dvec2& uv) {
    const BrickPlace place = find_brick(uv);
    const double face = glm::smoothstep(joint * 0.5, joint, std::min(place.edge.x, place.edge.y));
    const double tone = pick(9, place.brick.x, place.brick.y);
    const double grain = fractal_noise(uv, {32, 32}, 3, 11);
    const glm::dvec3 brick = glm::dvec3(150.0, 78.0, 58.0) * (0.75 + 0.3 * tone + 0.2 * grain);
    return glm::mix(glm::dvec3(176.0, 170.0, 160.0) * (0.85 + 0.2 * grain), brick, face);
}

/// x along u, y against v, as 8-bit values of a linear picture.
glm::u8vec3 brick_normal(int x, int y) {
    const double step = 1.0 / size;
    const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) * step;
    // A brick's height is 1 / rows of the picture; its width is twice that on the wall.
    const double across = (brick_height(uv + glm::dvec2(step, 0.0)) - brick_height(uv - glm::dvec2(step, 0.0))) /
                          (2.0 * step * columns * (rows / columns));
    const double down =
        (brick_height(uv + glm::dvec2(0.0, step)) - brick_height(uv - glm::dvec2(0.0, step))) / (2.0 * step * rows);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-across, down, 1.0));
    return glm::u8vec3(glm::floor((normal * 0.5 + 0.5) * 255.0 + 0.5));
}

DrawnTexture draw_normals() {
    DrawnTexture texture{"bricks_normal", Image<glm::u8vec3>(size, size)};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) texture.srgb(x, y) = brick_normal(x, y);
    }
    return texture;
}

/// Blue above, brighter at the horizon, brown ground, and a sun of about 6 degrees.
Image<Rgb> draw_sky() {
    constexpr int width = 128, height = 64;
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.75, -0.45));
    Image<Rgb> sky(width, height);
    for (int y = 0; y < height; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / height;
        for (int x = 0; x < width; ++x) {
            const double azimuth = 2.0 * std::numbers::pi * ((x + 0.5) / width - 0.5);
            const glm::dvec3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                       -std::sin(polar) * std::cos(azimuth));
            const double up = direction.y;
            const glm::dvec3 air =
                glm::mix(glm::dvec3(0.9, 0.95, 1.0), glm::dvec3(0.18, 0.35, 0.75), std::pow(std::max(up, 0.0), 0.6));
            const glm::dvec3 ground(0.18, 0.15, 0.12);
            const glm::dvec3 clouds(0.35 * fractal_noise({x / 128.0, y / 64.0}, {8, 8}, 4, 21));
            glm::dvec3 color = up > 0.0 ? air + clouds : ground;
            if (glm::dot(direction, sun) > std::cos(3.0 * std::numbers::pi / 180.0)) color = {260.0, 240.0, 205.0};
            sky(x, y) = Rgb(color);
        }
    }
    return sky;
}

}  // namespace

void write_materials_textures(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_textures(folder, {draw_texture("bricks", size, size, 2, brick_color), draw_normals()});
    const Image<Rgb> sky = draw_sky();
    ChannelImage file;
    for (int c = 0; c < 3; ++c) {
        Image<float> values(sky.width, sky.height);
        for (std::size_t i = 0; i < sky.size(); ++i) values.pixels[i] = sky.pixels[i][c];
        file.channels.push_back({std::string(1, "RGB"[c]), std::move(values)});
    }
    write_exr(folder / "sky.exr", file);
}

}  // namespace aleph
