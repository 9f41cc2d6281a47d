// Numbers of scenes made in code have the ranges of scene files.

#include <fmt/format.h>

#include "engine/load/validate_scene.h"
#include "engine/scene_file/fields.h"
#include "engine/scene_file/scene_text.h"
#include "tests/engine/load/full_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using RangeFault = std::pair<const char*, std::function<void(Scene&)>>;

void expect_all_refused_by_validate(const std::vector<RangeFault>& faults) {
    for (const auto& [message, make] : faults) {
        Scene scene = make_full_scene();
        make(scene);
        EXPECT_EQ(find_refusal([&] { validate(scene); }).message, message);
    }
}

Track<double> two_keys(double first, double second) {
    Track<double> track;
    track.values = {first, second};
    return track;
}

TEST(SceneRanges, Materials) {
    expect_all_refused_by_validate(
        {{"material 0: roughness has to lie between 0 and 1, found 7",
          [](Scene& s) { s.materials[0].gloss.roughness = 7.0; }},
         {"material 0: key 1 of metallic has to lie between 0 and 1, found -3",
          [](Scene& s) { s.materials[0].gloss.metallic = two_keys(1.0, -3.0); }},
         {"material 0: ior has to be 0 or at least 1, found 0.2", [](Scene& s) { s.materials[0].gloss.ior = 0.2; }},
         {"material 0: emission_strength has to be at least 0, found -1",
          [](Scene& s) { s.materials[0].glow.strength = -1.0; }},
         {"material 0: base_color has to lie between 0 and 1, found 2",
          [](Scene& s) { s.materials[0].base_color = glm::dvec3(0.5, 2.0, 0.5); }},
         {"material 0: emission has to be at least 0, found -5",
          [](Scene& s) { s.materials[0].glow.color = glm::dvec3(0.0, 0.0, -5.0); }},
         {"material 0: a number of it has to be finite and within +-1e+18, found 1e+300",
          [](Scene& s) { s.materials[0].glow.strength = 1e300; }},
         {"material 0: normal_scale has to be finite and within +-1e+18, found nan",
          [](Scene& s) { s.materials[0].textures.normal_scale = not_a_number; }},
         {"material 0: alpha_cutoff has to be at least 0, found -1",
          [](Scene& s) { s.materials[0].opacity.cutoff = -1.0; }},
         {"material 0: base_color_texture has to be finite and within +-1e+18, found nan",
          [](Scene& s) { s.materials[0].textures[TextureSlot::base_color].uv_scale.y = not_a_number; }}});
    Scene scene = make_full_scene();
    scene.materials[0].gloss.ior = 0.0;  // reflects everything
    EXPECT_NO_THROW(validate(scene));
}

TEST(SceneRanges, LightsAndCameras) {
    const double degree = std::numbers::pi / 180.0;
    expect_all_refused_by_validate(
        {{"light 0: intensity has to be at least 0, found -5", [](Scene& s) { s.lights[0].intensity = -5.0; }},
         {"light 0: color has to be at least 0, found -1",
          [](Scene& s) { s.lights[0].color = glm::dvec3(1.0, -1.0, 1.0); }},
         {"light 0: range has to be at least 0, found -3", [](Scene& s) { s.lights[0].range = -3.0; }},
         {"light 0: outer_cone has to lie between 0 and 90, found 170 degrees",
          [=](Scene& s) { s.lights[0].outer_cone = 170.0 * degree; }},
         {"light 0: \"inner_cone\", where the light begins to fade, cannot be wider than \"outer_cone\", where it ends",
          [](Scene& s) { s.lights[0].inner_cone = 1.5; }},
         {"camera 0: key 1 of fov has to lie between 0 and 180, both excluded, found 200 degrees",
          [=](Scene& s) { s.cameras[0].fov = two_keys(1.0, 200.0 * degree); }},
         {"camera 0: aperture has to be at least 0, found -1", [](Scene& s) { s.cameras[0].aperture = -1.0; }},
         {"camera 0: half_height has to be above 0, found -1", [](Scene& s) { s.cameras[0].half_height = -1.0; }},
         {"camera 0: shutter has to be finite and within +-1e+18, found nan",
          [](Scene& s) { s.cameras[0].shutter.y = not_a_number; }}});
}

TEST(SceneRanges, FilmAndNodes) {
    constexpr const char* far = "frames have to lie within 9e15 of 0";
    const std::string range = fmt::format("range: {}", far), cuts = fmt::format("cuts: {}", far),
                      key = fmt::format("camera key 0 \"eye\": {}", far);
    expect_all_refused_by_validate(
        {{"exposure: has to be above 0 and at most 1e+18, found 1e+308", [](Scene& s) { s.film.exposure = 1e308; }},
         {"viewing: persistence has to be above 0 and at most 1, found 0",
          [](Scene& s) { s.film.viewing.persistence = 0.0; }},
         {range.c_str(),
          [](Scene& s) {
              s.film.range = FrameRange{INT64_MIN, INT64_MAX};
          }},
         {cuts.c_str(), [](Scene& s) { s.film.cuts = {INT64_MAX}; }},
         {key.c_str(),
          [](Scene& s) {
              s.film.camera_keys = {{INT64_MIN, "eye"}};
          }},
         {"environment 0: radiance has to be at least 0, found -1",
          [](Scene& s) { s.environment.radiance = glm::dvec3(-1.0, 0.0, 0.0); }},
         {"node 0 \"ball\": visible has to be 0, 1 or 2, found 0.5", [](Scene& s) { s.nodes[0].visible = 0.5; }},
         {"mesh 0 \"rigid\": present has to be 0 or 1, found 2", [](Scene& s) { s.meshes[0].present = 2.0; }},
         {"node 1 \"eye\": a number of it has to be finite and within +-1e+18, found 1e+300",
          [](Scene& s) { s.nodes[1].transform.translation = glm::dvec3(0.0, 1e300, 0.0); }},
         {"include 0 \"a.glb\": refers to node 99, but there are only 2", [](Scene& s) {
              s.source.includes.resize(1);
              s.source.includes[0].path = "a.glb";
              s.source.includes[0].node = 99;
          }}});
}

/// Arrays that ended the program, and motion that was wrong or vanished.
TEST(SceneRanges, ImagesCagesAndSkins) {
    expect_all_refused_by_validate(
        {{"image 0: needs width * height pixels", [](Scene& s) { s.images[0].floats.width = 100000; }},
         {"image 0: needs width * height pixels",
          [](Scene& s) {
              s.images[0].floats.width = -2;
              s.images[0].floats.height = -1;
          }},
         {"image 0: has no pixels",
          [](Scene& s) {
              s.images[0].floats = {};
              s.environment.image = no_index;
          }},
         {"node 1 \"eye\": mesh 1 has a skin and another node already", [](Scene& s) { s.nodes[1].meshes = {1}; }},
         {"mesh 1 \"skinned\": a weight of a joint is not finite",
          [](Scene& s) { s.meshes[1].deformation.joint_weights[0].weight = float_nan; }},
         {"mesh 1 \"skinned\": a displacement of a morph target is not finite",
          [](Scene& s) { s.meshes[1].deformation.targets[0].positions[2].y = float_nan; }},
         {"skin 0: key 0: its matrix is not affine: the last row must be 0 0 0 1",
          [](Scene& s) { s.skins[0].inverse_binds[0] = glm::dmat4(2.0); }},
         {"mesh 0 \"rigid\": radius has to lie within 1e-18 and 1e+18, found -3",
          [](Scene& s) { s.meshes[0].shape = Shape{.kind = Shape::Kind::sphere, .radius = -3.0}; }}});
}

TEST(SceneRanges, CagesHaveLevelsAndParts) {
    const Scene valid = read_scene_text(R"({"aleph": 1, "points": {"p": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]},
        "cages": {"c": {"points": "p", "faces": [[0, 1, 2, 3]]}},
        "nodes": [{"name": "n", "shape": {"type": "cage", "cage": "c"}}]})",
                                        "")
                            .scene;
    EXPECT_NO_THROW(validate(valid));
    for (const auto& [message, make] : std::vector<RangeFault>{
             {"cage 0 \"c\": level has to lie between 0 and 10, found 40", [](Scene& s) { s.cages[0].level = 40; }},
             {"cage 0 \"c\": max_level has to lie between 0 and 10, found -3",
              [](Scene& s) { s.cages[0].max_level = -3; }},
             {"mesh 0 \"n\": refers to part of its cage 9, but there is only 1",
              [](Scene& s) { s.meshes[0].subdivision.part = 9; }}}) {
        Scene scene = valid;
        make(scene);
        EXPECT_EQ(find_refusal([&] { validate(scene); }).message, message);
    }
}

/// The reader of scene files and validate refuse the same numbers of an element, with the same words.
template <class Fields, class Element>
void expect_same_ranges(const Fields& fields, std::vector<Element> Scene::*list, const std::string& text) {
    for (const auto& field : fields) {
        if (std::string_view(field.key) == "focus") continue;  // counts with an aperture only
        for (const double value : {field.range.low - 1.0, field.range.low, field.range.high, field.range.high + 1.0}) {
            if (std::abs(value) >= 1e18) continue;
            Scene scene = make_full_scene();
            field.in((scene.*list)[0]) = value;
            const std::string in_code = find_refusal([&] { validate(scene); }).message;
            const std::string file = fmt::format(fmt::runtime(text), fmt::format("\"{}\": {}", field.key, value));
            const std::string in_file = find_refusal([&] { read_scene_text(file, "a.json"); }).message;
            EXPECT_EQ(in_code.empty(), field.range.holds(value)) << field.key << " " << value;
            EXPECT_EQ(in_file.empty(), in_code.empty()) << in_file << in_code;
            if (in_code.empty()) continue;
            EXPECT_NE(in_code.find(describe_outside(field.range, value)), std::string::npos) << in_code;
            EXPECT_NE(in_file.find(describe_outside(field.range, value)), std::string::npos) << in_file;
        }
    }
}

TEST(SceneRanges, AreThoseOfSceneFiles) {
    expect_same_ranges(material_numbers, &Scene::materials, R"({{"aleph": 1, "materials": {{"a": {{{}}}}}}})");
    expect_same_ranges(light_numbers, &Scene::lights, R"({{"aleph": 1, "lights": {{"a": {{"type": "point", {}}}}}}})");
    expect_same_ranges(camera_numbers, &Scene::cameras,
                       R"({{"aleph": 1, "cameras": {{"a": {{"orthographic": true, {}}}}}}})");
}

TEST(SceneRanges, APersistenceOf0IsRefusedWhereItIsRead) {
    const Refusal found =
        find_refusal([] { read_scene_text(R"({"aleph": 1, "viewing": {"persistence": 0}})", "a.json"); });
    EXPECT_NE(found.message.find("/viewing/persistence"), std::string::npos) << found.message;
}

}  // namespace
}  // namespace aleph
