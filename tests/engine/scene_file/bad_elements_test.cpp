// Broken elements of scene files: materials, cameras, lights, nodes, keys, shapes.

#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(BadSceneFile, Materials) {
    expect_all_refused({
        material("\"roughnes\": 0.5", "/roughnes", "did you mean \"roughness\""),
        material("\"texture\": \"a.png\"", "/texture", "normal_texture"),
        material("\"base_color\": 0.5", "/base_color", "expected a list of 3 numbers"),
        material("\"base_color\": [0.5, 0.5, 1.5]", "/base_color/2", "between 0 and 1"),
        material("\"base_color\": [0.5, \"x\", 1]", "/base_color/1", "a number, found the text \"x\""),
        material("\"roughness\": -0.1", "/roughness", "between 0 and 1"),
        material("\"metallic\": 1.0001", "/metallic", "between 0 and 1"),
        material("\"alpha\": true", "/alpha", "found true"),
        material("\"ior\": 0.9", "/ior", "at least 1"),
        material("\"emission\": [1, 1, -1]", "/emission/2", "at least 0"),
        material("\"emission_strength\": 1e19", "/emission_strength", "1e+18"),
        material("\"double_sided\": \"yes\"", "/double_sided", "true or false"),
        material("\"roughness\": {\"keys\": [[0, 0.5], [1, 2]]}", "/roughness/keys/1/1", "between 0 and 1"),
        material("\"base_color_texture\": 5", "/base_color_texture", "an image"),
        material("\"base_color_texture\": {\"uv_set\": 0}", "/base_color_texture", "\"image\" is missing"),
        material("\"base_color_texture\": {\"image\": \"a.png\", \"uv_set\": 2}", "/base_color_texture/uv_set",
                 "from 0 to 1"),
        material("\"base_color_texture\": {\"image\": \"a.png\", \"wrap\": \"tile\"}", "/base_color_texture/wrap",
                 "\"repeat\""),
        material("\"alpha_mode\": \"clip\"", "/alpha_mode", "\"mask\""),
        material("\"alpha_cutoff\": 0.5", "/alpha_cutoff", "needs \"alpha_mode\""),
        material("\"transmission\": 2", "/transmission", "between 0 and 1"),
        material("\"unlit\": 1", "/unlit", "true or false"),
        material("\"thickness\": -0.001", "/thickness", "at least 0"),
        material("\"thickness\": {\"keys\": [[0, 1], [5, -1]]}", "/thickness/keys/1/1", "at least 0"),
        material("\"attenuation_distance\": -1", "/attenuation_distance", "at least 0"),
        material("\"attenuation_color\": [0, 2, 0]", "/attenuation_color/1", "between 0 and 1"),
        material("\"attenuation_color\": 0.5", "/attenuation_color", "expected a list of 3 numbers"),
        material("\"clearcoat\": 1.5", "/clearcoat", "between 0 and 1"),
        material("\"clearcoat_roughness\": -0.5", "/clearcoat_roughness", "between 0 and 1"),
        material("\"clearcoat_normal_scale\": [1, 1]", "/clearcoat_normal_scale", "a number"),
        material("\"clear_coat\": 1", "/clear_coat", "did you mean \"clearcoat\""),
        material("\"sheen_color\": [1, 1, 1.01]", "/sheen_color/2", "between 0 and 1"),
        material("\"sheen_roughness\": 2", "/sheen_roughness", "between 0 and 1"),
        material("\"anisotropy\": -0.5", "/anisotropy", "between 0 and 1"),
        material("\"anisotropy_rotation\": \"x\"", "/anisotropy_rotation", "the text \"x\""),
        material("\"anisotropy_rotation\": 1, \"anisotropy_rotation_radians\": 1", "/anisotropy_rotation_radians",
                 "not both"),
        material("\"normal_scale\": {\"keys\": [[0, 1]]}", "/normal_scale", "a number"),
        material("\"normal_texture\": \"/etc/n.png\"", "/normal_texture", "absolute"),
        material("\"normal_map\": \"n.png\"", "/normal_map", "unknown key"),
        material("\"base_color_texture\": {\"image\": \"a.png\", \"scale\": 2}", "/base_color_texture/scale",
                 "2 numbers"),
        material("\"base_color_texture\": {\"image\": \"a.png\", \"rotation\": 2, \"rotation_radians\": 1}",
                 "/base_color_texture/rotation_radians", "either"),
        material("\"base_color_texture\": \"/etc/a.png\"", "/base_color_texture", "absolute"),
        material("\"base_color_texture\": \"http://a.b/c.png\"", "/base_color_texture", "addresses"),
        material("\"base_color_texture\": \"file:a.png\"", "/base_color_texture", "addresses"),
        material("\"base_color_texture\": \"C:/a.png\"", "/base_color_texture", "drives"),
        material("\"base_color_texture\": \"a\\\\b.png\"", "/base_color_texture", "backslash"),
        material("\"base_color_texture\": \"a\\u0000.png\"", "/base_color_texture", "control"),
        material("\"base_color_texture\": \"\"", "/base_color_texture", "an image"),
        scene("\"materials\": {\"a/b\": {\"x~\": 1}}", "/materials/a~1b/x~0", "unknown key"),
        scene("\"materials\": {\"a\": {}, \"a\": {}}", "/materials/a", "twice"),
        scene("\"images\": {\"a\": \"../../a.png\", \"b\": \"~/b.png\"}", "/images/b", "absolute"),
    });
}

TEST(BadSceneFile, CamerasAndLights) {
    const auto camera = [](const std::string& body, const std::string& place, const std::string& word) {
        return scene("\"cameras\": {\"main\": {" + body + "}}", "/cameras/main" + place, word);
    };
    const auto light = [](const std::string& body, const std::string& place, const std::string& word) {
        return scene("\"lights\": {\"key\": {" + body + "}}", "/lights/key" + place, word);
    };
    expect_all_refused({
        camera("\"fov\": 0", "/fov", "between 0 and 180"),
        camera("\"fov\": 180", "/fov", "between 0 and 180"),
        camera("\"fov\": -45", "/fov", "found -45"),
        camera("\"fov\": {\"keys\": [[0, 45], [10, 200]]}", "/fov/keys/1/1", "found 200"),
        camera("\"fov\": 45, \"fov_radians\": 1", "/fov_radians", "not both"),
        camera("\"fov_radians\": 3.2", "/fov_radians", "between 0 and"),
        camera("\"near\": 0", "/near", "above 0"),
        camera("\"half_height\": 2", "/half_height", "orthographic"),
        camera("\"orthographic\": true, \"half_height\": 0", "/half_height", "above 0"),
        camera("\"shutter\": [0.5, -0.5]", "/shutter", "open before"),
        camera("\"shutter\": 0.5", "/shutter", "2 numbers"),
        camera("\"aperture\": -1", "/aperture", "at least 0"),
        camera("\"focus\": 0", "/focus", "above 0"),
        camera("\"focal_length\": 35", "/focal_length", "unknown key"),
        light("\"intensity\": 3", "", "\"type\" is missing"),
        light("\"type\": \"spt\"", "/type", "\"spot\""),
        light("\"type\": \"point\", \"outer_cone\": 30", "/outer_cone", "only a spot"),
        light("\"type\": \"spot\", \"outer_cone\": 91", "/outer_cone", "between 0 and 90"),
        light("\"type\": \"spot\", \"inner_cone\": 50", "", "wider than"),
        light("\"type\": \"spot\", \"inner_cone\": 5, \"inner_cone_radians\": 0.1", "/inner_cone_radians", "either"),
        light("\"type\": \"point\", \"color\": [1, 1]", "/color", "3 numbers"),
        light("\"type\": \"point\", \"color\": [1, 1, -0.5]", "/color/2", "at least 0"),
        light("\"type\": \"point\", \"intensity\": -1", "/intensity", "at least 0"),
        light("\"type\": \"point\", \"range\": -1", "/range", "at least 0"),
        light("\"type\": \"directional\", \"range\": 3", "/range", "no range"),
    });
}

TEST(BadSceneFile, Nodes) {
    expect_all_refused({
        node("\"translate\": [0, 0, 0]", "/translate", "did you mean \"translation\""),
        node("\"translation\": [0, 0]", "/translation", "expected a list of 3 numbers, found a list of 2"),
        node("\"translation\": \"up\"", "/translation", "found the text \"up\""),
        node("\"translation\": [0, null, 0]", "/translation/1", "found null"),
        node("\"translation\": [0, 1e19, 0]", "/translation/1", "1e+18"),
        node("\"rotation\": [0, 0, 0]", "/rotation", "4 numbers"),
        node("\"rotation\": {\"axis\": [0, 1, 0]}", "/rotation", "degrees"),
        node("\"rotation\": {\"axis\": [0, 1, 0], \"degrees\": 1, \"radians\": 1}", "/rotation", "either"),
        node("\"rotation\": {\"axis\": [0, 0, 0], \"degrees\": 1}", "/rotation/axis", "zero"),
        node("\"rotation\": {\"axis\": [0, 1, 0], \"degres\": 1}", "/rotation/degres", "did you mean \"degrees\""),
        node("\"rotation\": {\"axis\": [0, 1, 0], \"degrees\": {\"keys\": [[0, \"x\"]]}}", "/rotation/degrees/keys/0/1",
             "a number"),
        node("\"scale\": \"big\"", "/scale", "a number, a list of 3 numbers or"),
        node("\"scale\": [1, 1, {}]", "/scale/2", "empty object"),
        node("\"matrix\": [1, 0, 0, 0]", "/matrix", "16 numbers"),
        node("\"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0.5,1]", "/matrix/14", "last row"),
        node("\"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], \"scale\": 2", "/scale", "not both"),
        node("\"visible\": 1", "/visible", "true or false"),
        node("\"visible\": {\"keys\": [[0, true]], \"interpolation\": \"linear\"}", "/visible/interpolation",
             "\"step\""),
        node("\"mesh\": \"ball\"", "/mesh", "no mesh called \"ball\""),
        node("\"meshes\": [\"ball\"]", "/meshes/0", "no mesh called \"ball\""),
        node("\"material\": \"felt\"", "/material", "goes with \"shape\""),
        node("\"shape\": {\"type\": \"box\"}, \"material\": \"felt\"", "/material", "no material called"),
        node("\"shape\": {\"type\": \"box\"}, \"material\": {\"rough\": 1}", "/material/rough",
             "did you mean \"roughness\""),
        node("\"camera\": \"main\"", "/camera", "no camera called"),
        node("\"camera\": {\"fov\": \"wide\"}", "/camera/fov", "found the text \"wide\""),
        node("\"light\": \"key\"", "/light", "no light called"),
        node("\"children\": [{\"parent\": \"a\"}]", "/children/0/parent", "has a parent already"),
        node("\"children\": [{\"children\": [{\"nam\": \"x\"}]}]", "/children/0/children/0/nam",
             "did you mean \"name\""),
        node("\"include\": \"/a.glb\"", "/include", "absolute"),
        node("\"include\": [\"a.glb\", \"\"]", "/include/1", "relative path"),
        scene(R"("nodes": [{"name": "ball"}, {"name": "ball"}])", "/nodes/1/name", "two nodes"),
        scene(R"("nodes": [{"name": "table"}, {"parent": "tabel"}])", "/nodes/1/parent", "did you mean \"table\""),
        scene(R"("nodes": [{"name": "a", "parent": "b"}, {"name": "b", "parent": "a"}])", "/nodes/0/parent", "before"),
        scene(R"("nodes": [{"name": "a", "parent": "a"}])", "/nodes/0/parent", "below itself"),
        scene(R"("nodes": [{"name": "a", "instance": "b"}, {"name": "b"}])", "/nodes/0/instance", "before"),
        scene(R"("nodes": [{"name": "a"}, {"instance": "a"}])", "/nodes/1/instance", "meshes or a light"),
        scene(R"("nodes": [{"name": "a", "shape": {"type": "box"}, "children": [{"children": [{"instance": "a"}]}]}])",
              "/nodes/0/children/0/children/0/instance", "hold itself"),
        scene(R"("nodes": [{"name": "a", "shape": {"type": "box"}}, {"name": "b", "instance": "a"},
                           {"name": "c", "parent": "a", "children": [{"light": {"type": "point"}}]}])",
              "/nodes/2/children/0", "before \"b\""),
        node("\"inherits\": 0", "/inherits", "true or false"),
        node("\"visible\": \"sometimes\"", "/visible", "\"always\""),
        node("\"operations\": {}", "/operations", "a list of operations"),
        node("\"operations\": [{}]", "/operations/0", "one key"),
        node("\"operations\": [{\"rotate_x\": 1, \"rotate_y\": 1}]", "/operations/0", "one key"),
        node("\"operations\": [{\"turn\": 1}]", "/operations/0/turn", "unknown key"),
        node("\"operations\": [{\"rotate\": {\"axis\": [0, 1, 0]}}]", "/operations/0/rotate", "either \"degrees\""),
        node("\"operations\": [], \"scale\": 2", "/scale", "either \"operations\" or \"scale\""),
        node("\"operations\": [], \"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "/operations",
             "either \"matrix\""),
        node("\"operations\": [{\"rotate_x\": {\"keys\": [[0, 1], [5, 2]], \"interpolation\": \"step\"}}]",
             "/operations/0/rotate_x", "linear"),
        node("\"operations\": [{\"rotate_x\": {\"keys\": [[0, 1], [5, 2]]}}, {\"rotate_y\": {\"keys\": [[0, 1], [6, "
             "2]]}}]",
             "/operations/1/rotate_y", "same times"),
        scene(R"("nodes": [{"name": "a"}, {"parent": ""}])", "/nodes/1/parent", "no node called"),
        scene(R"("materials": {"felt": {}, "wood": {}}, "nodes": [{"shape": {"type": "box"}, "material": "flet"}])",
              "/nodes/0/material", "did you mean \"felt\""),
    });
}

TEST(BadSceneFile, KF05_ZeroQuaternion) {
    expect_all_refused({
        node("\"rotation\": [0, 0, 0, 0]", "/rotation", "zero"),
        node("\"rotation\": {\"keys\": [[0, [0, 0, 0, 1]], [5, [0, 0, 0, 0]]]}", "/rotation", "key 1"),
    });
}

TEST(BadSceneFile, KF10_KF11_KeyTimes) {
    const auto keys = [](const std::string& inner, const std::string& place, const std::string& word) {
        return node("\"scale\": {" + inner + "}", "/scale" + place, word);
    };
    expect_all_refused({
        keys("\"keys\": [[0, 1], [1, 1], [1, 2]]", "/keys/2/0", "ascend"),
        keys("\"keys\": [[0, 1], [2, 1], [1, 2]]", "/keys/2/0", "ascend"),
        keys("\"keys\": [[0, 1], [1e19, 1]]", "/keys/1/0", "1e+18"),
        keys("\"keys\": [[\"0\", 1]]", "/keys/0/0", "a time"),
        keys("\"keys\": []", "/keys", "found a list of 0"),
        keys("\"keys\": [{\"frame\": 0}]", "/keys/0", "a key: [time, value]"),
        keys("\"keys\": [[0]]", "/keys/0", "a key: [time, value]"),
        keys("\"keys\": [[0, 1, 2]]", "/keys/0", "found a list of 3"),
        keys("\"keys\": [[0, 1, 2, 3]]", "/keys/0", "cubic"),
        keys("\"interpolation\": \"cubic\", \"keys\": [[0, 1]]", "/keys/0", "in-tangent"),
        keys("\"interpolation\": \"cubic\", \"values\": [1]", "/values/0", "in-tangent"),
        keys("\"interpolation\": \"bezier\", \"keys\": [[0, 1]]", "/interpolation", "\"cubic\""),
        keys("\"unit\": \"hours\", \"keys\": [[0, 1]]", "/unit", "\"frames\""),
        keys("\"interpolation\": \"linear\"", "", "neither"),
        keys("\"keys\": [[0, 1]], \"values\": [1]", "", "not both"),
        keys("\"keys\": [[0, 1]], \"start\": 3", "/start", "goes with \"values\""),
        keys("\"values\": [1], \"period\": 0", "/period", "above 0"),
        keys("\"values\": [1, 2], \"cycle\": [0, 0.5], \"start\": 1", "/start", "cycle"),
        keys("\"values\": [1, 2], \"cycle\": [0.5, 0]", "/cycle/1", "ascend"),
        keys("\"values\": [1, 2], \"cycle\": [0, 2]", "/cycle", "within one \"period\""),
        keys("\"values\": []", "/values", "found a list of 0"),
        keys("\"key\": [[0, 1]]", "/key", "did you mean \"keys\""),
        keys("\"keys\": {\"0\": 1}", "/keys", "found an object"),
    });
}

TEST(BadSceneFile, Shapes) {
    expect_all_refused({
        shape("\"radius\": 1", "", "\"type\" is missing"),
        shape("\"type\": \"tours\"", "/type", "\"torus\""),
        shape("\"type\": \"torus\", \"tube_radius\": 0.5", "", "smaller than radius"),
        shape("\"type\": \"torus\", \"height\": 1", "/height", "a torus has no"),
        shape("\"type\": \"sphere\", \"tube_radius\": 1", "/tube_radius", "a sphere has no"),
        shape("\"type\": \"lathe\"", "", "two different points"),
        shape("\"type\": \"lathe\", \"profile\": [[1, 0]]", "/profile", "a list of points"),
        shape("\"type\": \"lathe\", \"profile\": [[1, 0], [1]]", "/profile/1", "2 numbers"),
        shape("\"type\": \"lathe\", \"profile\": [[1, 0], [1, 0]]", "", "two different points"),
        shape("\"type\": \"lathe\", \"profile\": [[0, 0], [0, 1]]", "", "axis"),
        shape("\"type\": \"lathe\", \"profile\": [[1, 0], [-1, 1]]", "", "point 1"),
        shape("\"type\": \"lathe\", \"profile\": [[1, 0], [1, 1]], \"smooth\": 1", "/smooth", "true or false"),
        shape("\"type\": \"sphere\", \"radius\": -1", "/radius", "above 0"),
        shape("\"type\": \"sphere\", \"radius\": 0", "/radius", "above 0"),
        shape("\"type\": \"sphere\", \"radius\": 1e-30", "", "radius has to lie"),
        shape("\"type\": \"sphere\", \"radius\": 1e19", "/radius", "1e+18"),
        shape("\"type\": \"sphere\", \"segments\": 2", "/segments", "from 3 to 4096"),
        shape("\"type\": \"sphere\", \"segments\": 4097", "/segments", "from 3 to 4096"),
        shape("\"type\": \"sphere\", \"segments\": 12.0", "/segments", "a whole number"),
        shape("\"type\": \"sphere\", \"size\": [1, 1, 1]", "/size", "a sphere has no \"size\""),
        shape("\"type\": \"sphere\", \"height\": 1", "/height", "a sphere has no \"height\""),
        shape("\"type\": \"box\", \"size\": [1, 1]", "/size", "3 numbers"),
        shape("\"type\": \"box\", \"size\": [1, 1, -1]", "", "size z"),
        shape("\"type\": \"box\", \"radius\": 1", "/radius", "a box has no"),
        shape("\"type\": \"quad\", \"size\": [1, 1, 1]", "/size", "2 numbers"),
        shape("\"type\": \"quad\", \"size\": [0, 1]", "", "size x"),
        shape("\"type\": \"cylinder\", \"height\": 0", "/height", "above 0"),
        shape("\"type\": \"cylinder\", \"uv_scale\": [1]", "/uv_scale", "2 numbers"),
        scene(R"("meshes": {"a": {"positions": [0, 0, 0]}})", "/meshes/a/positions", "unknown key"),
        scene(R"("meshes": {"a": {}})", "/meshes/a", "\"shape\" is missing"),
    });
}

}  // namespace
}  // namespace aleph
