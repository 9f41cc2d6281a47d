#include "scenes/pool/pool_scene.h"

#include <cmath>
#include <glm/trigonometric.hpp>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "scenes/pool/break.h"
#include "scenes/pool/build.h"
#include "scenes/pool/textures.h"

namespace aleph {

namespace {

Material make_lambert(const std::string& name) {
    Material material;
    material.name = name;
    material.metallic = 0.0;
    material.specular = 0.0;
    return material;
}

int add_material(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void add_images(Scene& scene, const std::string& folder, const std::vector<PoolTexture>& textures) {
    for (const PoolTexture& texture : textures) {
        SceneImage image;
        image.name = texture.name;
        image.path = folder + texture.name + ".png";
        image.bytes = Image<glm::u8vec4>(texture.srgb.width, texture.srgb.height);
        for (std::size_t i = 0; i < texture.srgb.size(); ++i)
            image.bytes.pixels[i] = glm::u8vec4(texture.srgb.pixels[i], 255);
        scene.images.push_back(image);
    }
}

}  // namespace

int add_lambert(Scene& scene, const std::string& name, const glm::dvec3& srgb) {
    Material material = make_lambert(name);
    glm::dvec3 linear;
    // Four digits are more than eight bits of sRGB hold, and read well in a file.
    for (int i = 0; i < 3; ++i)
        linear[i] = std::round(1e4 * srgb_to_linear(static_cast<float>(srgb[i]) / 255.0f)) / 1e4;
    material.base_color = linear;
    return add_material(scene, material);
}

int add_textured(Scene& scene, const std::string& name, const std::string& image) {
    Material material = make_lambert(name);
    for (std::size_t i = 0; i < scene.images.size(); ++i)
        if (scene.images[i].name == image) material.base_color_texture.image = static_cast<int>(i);
    ALEPH_CHECK(material.base_color_texture.image != no_index, image);
    return add_material(scene, material);
}

int add_emitter(Scene& scene, const std::string& name, const glm::dvec3& color, double radiance) {
    Material material = make_lambert(name);
    material.base_color = glm::dvec3(0.8);
    material.emission = color;
    material.emission_strength = radiance;
    return add_material(scene, material);
}

void add_gloss(Scene& scene, double roughness) {
    scene.materials.back().specular = 1.0;
    scene.materials.back().roughness = roughness;
}

void add_camera(Scene& scene, bool moves) {
    // It turns on an arm of a quarter of a metre: a pan with a little parallax. Walls move by about 3 pixels a frame at
    // 640x480.
    const double first = -20.0, last = 3.0;  // degrees about y; -x lies ahead at 0
    const int rig = add_node(scene, "camera_rig", no_index, {1.625, 0.0, 0.195});
    AxisRotation turn;
    turn.angle = glm::radians(first);
    if (moves) {
        turn.angle.sampling.period = last_frame / 30.0;
        turn.angle.values = {glm::radians(first), glm::radians(last)};
    }
    scene.nodes[static_cast<std::size_t>(rig)].axis_rotation = turn;

    const glm::dquat ahead = z_to_plus_x * glm::angleAxis(glm::radians(-12.5), glm::dvec3(1.0, 0.0, 0.0));
    const int node = add_node(scene, "camera", rig, {0.25, 1.27, 0.0}, ahead);
    Camera camera;
    camera.name = "camera";
    camera.fov = glm::radians(40.0);
    scene.cameras.push_back(camera);
    scene.nodes[static_cast<std::size_t>(node)].camera = 0;
}

Scene make_pool_scene(bool camera_moves, const std::string& textures) {
    const PoolSettings settings;
    const double duration = last_frame / 30.0 - strike_time;
    const PoolRun run = simulate_pool(make_rack(settings), settings, duration, samples_per_second);

    Scene scene;
    scene.name = camera_moves ? "pool" : "pool-still";
    scene.range = FrameRange{0, last_frame};
    scene.camera = "camera";
    // By eye. The automatic exposure goes by direct light alone, of which the walls get little: the cloth would burn
    // out.
    scene.exposure = 3.0;
    add_images(scene, textures, make_room_textures());
    add_images(scene, textures, make_ball_textures());
    add_room(scene);
    add_lights(scene);
    add_table(scene, settings);
    add_balls(scene, settings, run);
    add_cue(scene, settings, run.samples.front()[cue_ball]);
    add_camera(scene, camera_moves);
    return scene;
}

}  // namespace aleph
