// Broken scene files: each is refused with the file, the place in it and the reason, and with advice about keys and
// values that other programs have.

#include <cstdlib>

#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

std::string nested(int depth, const std::string& open, const std::string& inner, const std::string& close) {
    std::string out;
    for (int i = 0; i < depth; ++i) out += open;
    out += inner;
    for (int i = 0; i < depth; ++i) out += close;
    return out;
}

TEST(BadSceneFile, Syntax) {
    expect_all_refused({
        {"", "line 1, column 1", "JSON"},
        {"  \n ", "line 2, column 2", "unexpected end"},
        {"{", "line 1, column 2", "unexpected end"},
        {"{\"aleph\": 1,}", "line 1, column 12", "this comma is one too many"},
        {"{\"aleph\": 1, \"frames\": [0, 1 ,\n]}", "line 1, column 30", "this comma is one too many"},
        {"{\"aleph\": 1, \"nodes\": [{} {}]}", "line 1, column 26", "a comma is missing here"},
        {"{\"aleph\": 1, \"frames\": [0 1]}", "line 1, column 26", "a comma is missing here"},
        {"{\"aleph\": 1, \"a\": [true  false]}", "line 1, column 24", "a comma is missing here"},
        {"{\"aleph\": 1, \"a\": [0, 1}", "line 1, column 24", "JSON: syntax error"},
        {"{\"aleph\": 1}}", "line 1, column 13", "JSON"},
        {"{\n  \"aleph\": 1\n  \"nodes\": []\n}", "line 2, column 13", "a comma is missing here"},
        {"{\"aleph\": 01}", "line 1, column 12", "JSON: syntax error"},
        {"{\"aleph\": NaN}", "line 1, column 11", "JSON"},
        {"{\"aleph\": 1 /* never closed", "line 1, column 28", "comment"},
        {"{\"ä\": nul}", "line 1, column 10", "JSON"},
        {"{\"aleph\": 1, \"name\": \"\xff\"}", "line 1, column 23", "UTF-8"},
        {std::string("{\"aleph\": 1\0}", 13), "line 1, column 12", "JSON"},
        {"\x89PNG\r\n", "line 1, column 1", "JSON"},
        {"{\"aleph\": 1,\n \"exposure\": 1e999}", "line 2, column 18", "too large"},
        {"{\"aleph\": -1e999}", "line 1, column 16", "too large"},
        scene("\"nodes\": [{\"translation\": [0, 1e400, 0]}]", "line 1, column 48", "too large"),
    });
}

TEST(BadSceneFile, KeysOfOtherFormatsNameTheirOwn) {
    expect_all_refused({
        scene(R"("nodes": [{"position": [0, 0, 1]}])", "/nodes/0/position", "\"translation\": [x, y, z]"),
        scene(R"("nodes": [{"children": [{"rotate": [0, 90, 0]}]}])", "/nodes/0/children/0/rotate",
              "\"axis\": [0, 1, 0], \"degrees\": 90"),
        scene(R"("nodes": [{"rotation": [0, 90, 0]}])", "/nodes/0/rotation", "{\"rotate_y\": 90}"),
        scene(R"("nodes": [{"light": {"type": "area"}}])", "/nodes/0/light/type",
              "a \"material\" that has \"emission\""),
        scene(R"("nodes": [{"camera": {"look_at": [0, 0, 0]}}])", "/nodes/0/camera/look_at", "-z of its node"),
        scene(R"("nodes": [{"shape": {"type": "cube"}}])", "/nodes/0/shape/type", "a cube is a \"box\""),
        scene(R"("settings": {"sampling": "progressive"})", "/settings/sampling", "write \"error\": 1"),
        scene(R"("objects": [])", "/objects", "listed in \"nodes\""),
        scene(R"("materials": {"a": {"colour": [1, 1, 1]}})", "/materials/a/colour", "a material is \"base_color\""),
        node(R"("rotation": {"axis": [0, 1, 0], "angle": 90})", "/rotation/angle",
             R"(; the angle of a rotation is "degrees", that of a camera "fov", that of a spot "outer_cone")"),
        node(R"("light": {"type": "point", "power": 60})", "/light/power",
             R"(; the strength of a light is "intensity")"),
        shape(R"("type": "mesh", "file": "x.obj")", "/file",
              R"(; meshes of other files are shown by "include": "FILE.glb")"),
        shape(R"("type": "sphere", "size": 1)", "/size",
              R"(; a sphere, cylinder or torus has a "radius", a quad [x, y], a box [x, y, z])"),
        node(R"("shape": "sphere")", "/shape", R"(; write {"type": "sphere"})"),
        node(R"("translation": [[0, [0, 0, 0]], [10, [1, 0, 0]]])", "/translation",
             R"(; keys are written as {"keys": [[0, ...], [10, ...]]})"),
        scene(R"("environment": "sky.exr")", "/environment", R"(; a picture is "environment_image")"),
        scene(R"("settings": {"samples": 64})", "/settings/samples", R"(; the samples of a pixel are "spp")"),
    });
    const auto reason = [](const std::string& body) { return find_refusal([&] { read(", " + body); }).reason; };
    EXPECT_EQ(reason(R"("settings": {"samples": 64})").find("light_samples"), std::string::npos) << "one is enough";
    EXPECT_EQ(reason(R"("nodes": [{"translation": [0, 1]}])").find(';'), std::string::npos) << "a number is missing";
}

TEST(BadSceneFile, Limits) {
    expect_all_refused({
        {nested(129, "[", "", "]"), "", "128 deep"},
        {nested(100000, "[", "", ""), "", "128 deep"},
        {nested(200, "{\"a\":", "1", "}"), "", "128 deep"},
        scene("\"nodes\": [" + nested(70, "{\"children\": [", "", "]}") + "]", "", "128 deep"),
        scene(R"("nodes": [{"shape": {"type": "sphere", "segments": 1024}},
            {"shape": {"type": "sphere", "segments": 4096}}])",
              "/nodes/1/shape", "lower \"segments\""),
    });
    // The memory is never touched: the size is checked before the text.
    constexpr std::size_t too_large = (std::size_t{64} << 20) + 1;
    const std::unique_ptr<char, void (*)(void*)> text(static_cast<char*>(std::calloc(too_large, 1)), std::free);
    EXPECT_THROW(read_scene_text({text.get(), too_large}, "broken.json"), InputError);
}

TEST(BadSceneFile, RP21_TopLevel) {
    expect_all_refused({
        {"[]", "", "expected an aleph scene"},
        {"null", "", "found null"},
        {"{}", "", "\"aleph\" is missing"},
        {"{\"aleph\": 2}", "/aleph", "version 2"},
        {"{\"aleph\": \"1\"}", "/aleph", "expected 1"},
        {"{\"aleph\": 1, \"aleph\": 1}", "/aleph", "twice"},
        scene("\"node\": []", "/node", "did you mean \"nodes\""),
        scene("\"nodes\": {}", "/nodes", "expected a list of nodes"),
        scene("\"nodes\": [7]", "/nodes/0", "expected a node, found 7"),
        scene("\"name\": 5", "/name", "a name"),
        scene("\"fps\": 0", "/fps", "a whole number from 1 to 1000000000, found 0"),
        scene("\"fps\": \"0/1\"", "/fps", "found the text \"0/1\""),
        scene("\"fps\": -30", "/fps", "found -30"),
        scene("\"fps\": 23.976", "/fps", "30000/1001"),
        scene("\"fps\": \"30000/0\"", "/fps", "30000/1001"),
        scene("\"fps\": \"fast\"", "/fps", "\"fast\""),
        scene("\"frames\": [0]", "/frames", "2 whole frame numbers, found a list of 1"),
        scene("\"frames\": [0, 1.5]", "/frames/1", "whole frame number"),
        scene("\"frames\": [10, 0]", "/frames", "before the first"),
        scene("\"frames\": [0, 1e9]", "/frames/1", "whole frame number"),
        scene("\"frames\": [0, 18446744073709551615]", "/frames/1", "must lie within"),
        scene("\"cuts\": [5, 5]", "/cuts/1", "ascend"),
        scene("\"viewing\": {\"pixels_per_degree\": 0}", "/viewing/pixels_per_degree", "above 0"),
        scene("\"viewing\": {\"display_white\": -1}", "/viewing/display_white", "above 0"),
        scene("\"viewing\": {\"display_white\": null}", "/viewing/display_white", "found null"),
        scene("\"viewing\": {\"display_white\": 1e19}", "/viewing/display_white", "1e+18"),
        scene("\"viewing\": {\"ppd\": 31}", "/viewing/ppd", "unknown key"),
        scene("\"viewing\": {\"persistence\": 2}", "/viewing/persistence", "a number from 0 to 1, found 2"),
        scene("\"viewing\": {\"persistence\": -0.1}", "/viewing/persistence", "a number from 0 to 1"),
        scene("\"exposure\": 0", "/exposure", "above 0"),
        scene("\"environment\": [1, 1]", "/environment", "3 numbers"),
        scene("\"environment\": [1, -1, 1]", "/environment/1", "at least 0"),
        scene("\"environment\": \"sky.exr\"", "/environment", "found the text \"sky.exr\""),
        scene("\"environment_image\": 5", "/environment_image", "an image (name or path), found 5"),
        scene("\"environment_image\": \"\"", "/environment_image", "an image"),
        scene("\"environment_image\": \"/srv/sky.exr\"", "/environment_image", "absolute"),
        scene("\"environment_image\": \"https://a.b/sky.exr\"", "/environment_image", "addresses"),
        scene("\"environment_rotation\": [0, 0, 0, 1]", "/environment_rotation",
              "turns \"environment_image\", which is not given"),
        scene("\"environment_image\": \"s.exr\", \"environment_rotation\": [0, 0, 0, 0]", "/environment_rotation",
              "zero"),
        scene("\"environment_image\": \"s.exr\", \"environment_rotation\": 90", "/environment_rotation", "4 numbers"),
        scene("\"environment_image\": \"s.exr\", \"environment_rotation\": {\"axis\": [0, 1, 0]}",
              "/environment_rotation", "degrees"),
        scene("\"environment_image\": \"s.exr\", \"environment_rotation\": {\"axis\": [0, 0, 0], \"degrees\": 5}",
              "/environment_rotation/axis", "zero"),
        scene("\"environment_map\": \"s.exr\"", "/environment_map", "did you mean"),
        scene("\"camera\": [\"main\"]", "/camera", "a name"),
        scene("\"include\": 5", "/include", "relative path"),
    });
}

TEST(BadSceneFile, Settings) {
    expect_all_refused({
        scene("\"settings\": {\"acuracy\": 0.1}", "/settings/acuracy", "did you mean \"accuracy\""),
        scene("\"settings\": {\"accuracy\": \"high\"}", "/settings/accuracy", "a number from 0 to 1"),
        scene("\"settings\": {\"accuracy\": -0.1}", "/settings/accuracy", "a number from 0 to 1"),
        scene("\"settings\": {\"gather\": 10.5}", "/settings/gather", "a whole number"),
        scene("\"settings\": {\"guide\": \"salience\"}", "/settings/guide", "\"saliency\""),
        scene("\"settings\": {\"size\": \"640\"}", "/settings/size", "640x480"),
        scene("\"settings\": {\"size\": \"0x0\"}", "/settings/size", "640x480"),
        scene("\"settings\": {\"neutral_opponent\": 1}", "/settings/neutral_opponent", "true or false"),
        scene("\"settings\": [1]", "/settings", "expected settings"),
    });
}

TEST(BadSceneFile, NamesAreEscapedAndShortened) {
    const std::string text = "{\"aleph\": 1, \"camera\": \"\", \"\\u001b[31m" + std::string(5000, 'x') + "\": 1}";
    const std::string what = find_refusal([&] { read_scene_text(text, "broken.json"); }).message;
    EXPECT_EQ(what.find('\x1b'), std::string::npos);
    EXPECT_NE(what.find("\\x1b"), std::string::npos);
    EXPECT_LT(what.size(), 500u);
}

}  // namespace
}  // namespace aleph
