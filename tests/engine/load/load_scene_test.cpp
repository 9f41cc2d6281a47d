// load_scene and save_scene on files: includes, pictures, the camera that is added, bad files.

#include "engine/load/load_scene.h"
#include "engine/image/image_file.h"
#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"
#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

TEST_F(LoadScene, PicturesAreDecoded) {
    Image<Rgb> picture(2, 1);
    picture(0, 0) = Rgb(1.0f, 0.0f, 0.0f);
    picture(1, 0) = Rgb(0.0f, 0.0f, 1.0f);
    write_png(folder_ / "lib/two.png", picture);
    write_exr(
        folder_ / "two.exr",
        {{{"R", Image<float>(1, 2, 4.0f)}, {"G", Image<float>(1, 2, 5.0f)}, {"B", Image<float>(1, 2, 6.0f)}}, {}});
    const Scene scene = load_scene(write_scene(R"("environment": [1, 1, 1], "materials": {"m": {
        "base_color_texture": "lib/two.png", "emission_texture": "two.exr"}})"));
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(scene.images[0].bytes.width, 2);
    EXPECT_EQ(scene.images[0].bytes(0, 0), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(scene.images[0].bytes(1, 0), glm::u8vec4(0, 0, 255, 255));
    EXPECT_TRUE(scene.images[0].floats.empty());
    EXPECT_TRUE(scene.images[1].bytes.empty());
    EXPECT_EQ(scene.images[1].floats.height, 2);
    EXPECT_EQ(scene.images[1].floats(0, 1), glm::vec4(4.0f, 5.0f, 6.0f, 1.0f));
    EXPECT_TRUE(scene.source.warnings.empty());
    expect_saved_and_loaded_alike(scene);
}

TEST_F(LoadScene, IncludesFollowTheScenesOwnElementsAndStayIncludes) {
    write("lib/triangle.gltf", moving_triangle().to_text());
    const Scene scene = load_scene(write_scene(R"("camera": "eye", "environment": [1, 1, 1], "nodes": [
        {"name": "left", "translation": [-5, 0, 0], "include": ["lib/triangle.gltf", "lib/../lib/triangle.gltf"]},
        {"name": "mover", "shape": {"type": "box"}, "material": {}}, {"name": "eye", "camera": {}}], "include": "lib/triangle.gltf")"));
    ASSERT_EQ(scene.source.includes.size(), 3u);
    ASSERT_EQ(scene.meshes.size(), 3u);  // the same path twice shares its mesh
    EXPECT_EQ(scene.meshes[0].include, no_index);
    std::vector<int> includes;
    for (const Node& node : scene.nodes) includes.push_back(node.include);
    EXPECT_EQ(includes, (std::vector<int>{-1, -1, -1, 0, 1, 2}));
    EXPECT_EQ(scene.nodes[3].name, "mover");
    EXPECT_EQ(scene.nodes[3].parent, 0);
    EXPECT_EQ(scene.nodes[4].parent, 0);
    EXPECT_EQ(scene.nodes[5].parent, no_index);
    EXPECT_EQ(pose(scene, 0.5).world[3][3], glm::dvec4(0.0, 0.0, 0.0, 1.0));
    EXPECT_EQ(pose(scene, 0.5).world[5][3], glm::dvec4(5.0, 0.0, 0.0, 1.0));

    expect_saved_and_loaded_alike(scene);
}

TEST_F(LoadScene, PathsChangeWithTheFolder) {
    write("lib/triangle.gltf", moving_triangle().to_text());
    write_png(folder_ / "dot.png", Image<Rgb>(1, 1));
    const Scene scene = load_scene(write_scene(
        R"("materials": {"m": {"base_color_texture": "dot.png"}}, "include": "lib/triangle.gltf", "environment": [1, 1, 1])"));
    save_scene(scene, folder_ / "lib/moved.json");
    const Scene moved = load_scene(folder_ / "lib/moved.json");
    EXPECT_EQ(moved.source.includes[0].path, "triangle.gltf");
    EXPECT_EQ(moved.images[0].path, "../dot.png");
    EXPECT_EQ(moved.nodes, scene.nodes);
    EXPECT_EQ(moved.images[0].bytes, scene.images[0].bytes);
}

TEST_F(LoadScene, GltfWithoutCameraGetsOneThatSeesEverythingAllTheTime) {
    Scene scene = load_scene(write("moving.gltf", moving_triangle().to_text()));
    EXPECT_TRUE(has_warning(scene, "no camera"));
    EXPECT_EQ(scene.source.name, "moving");
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].camera, 0);
    EXPECT_EQ(scene.nodes[1].name, "mover");
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 30}));
    double widest = 0.0;
    for (int frame = 0; frame <= 30; ++frame) {
        const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
        const CameraView view = make_camera_view(now.cameras.at(0), 640, 480);
        EXPECT_GT(view.position.y, 0.5);  // above the middle
        EXPECT_GT(view.position.z, 1.0);
        for (const glm::vec3& corner : scene.meshes[0].positions) {
            const glm::dvec3 p = to_camera(view, glm::dvec3(now.world[1] * glm::dvec4(corner, 1.0)));
            ASSERT_GT(-p.z, view.near_plane);
            const glm::dvec2 pixel = project_camera_point(view, p);
            EXPECT_TRUE(pixel.x > 0.0 && pixel.x < 640.0 && pixel.y > 0.0 && pixel.y < 480.0)
                << pixel.x << " " << pixel.y;
            widest = std::max(widest, std::abs(pixel.x - 320.0));
        }
    }
    EXPECT_GT(widest, 150.0);  // and does not look from far away

    scene.source.warnings.clear();
    expect_saved_and_loaded_alike(scene);
}

TEST_F(LoadScene, FilesThatCannotBeRead) {
    expect_refused(folder_ / "missing.json", "", "there is no file");
    expect_refused(folder_ / "missing.glb", "", "there is no file");
    fs::create_directories(folder_ / "folder.json");
    expect_refused(folder_ / "folder.json", "", "not a regular file");
    expect_refused(folder_, "", "expected a .json, .gltf, .glb or .abc");
    expect_refused(write("a.abc", "Ogawa"), "header", "ends inside its header");
    expect_refused(write("old.abc", "\x89HDF\r\n"), "", "abcconvert");
    expect_refused(write("a.obj", "v 0 0 0"), "", "\".obj\"");
    expect_refused("/dev/zero", "", "expected a .json");
    fs::create_symlink("/dev/zero", folder_ / "zero.json");
    expect_refused(folder_ / "zero.json", "", "not a regular file");
    write("huge.json", "");
    fs::resize_file(folder_ / "huge.json", (std::uintmax_t{64} << 20) + 1);
    expect_refused(folder_ / "huge.json", "", "larger than 64 MiB");
}

TEST_F(LoadScene, FilesThatASceneNamesAndThatCannotBeRead) {
    const auto refused = [&](const std::string& body, const std::string& place, const std::string& word) {
        expect_refused(write_scene(body), place, word);
    };
    fs::create_directories(folder_ / "dir.png");
    write("text.png", "not a picture");
    write("scene2.json", "{\"aleph\": 1}");
    refused(R"("include": "missing.glb")", "/include", "there is no file");
    refused(R"("nodes": [{}, {"include": ["missing.glb"]}])", "/nodes/1/include/0", "there is no file");
    refused(R"("include": "scene2.json")", "/include", ".gltf, .glb or .abc");
    refused(R"("include": "a.abc")", "/include", "there is no file");
    refused(R"("include": "lib")", "/include", ".gltf, .glb or .abc");
    refused(R"("materials": {"m": {"base_color_texture": "missing.png"}})", "/materials/m/base_color_texture",
            "there is no file");
    refused(R"("materials": {"m": {"base_color_texture": "dir.png"}})", "/materials/m/base_color_texture",
            "not a regular file");
    refused(R"("materials": {"m": {"base_color_texture": {"image": "text.png"}}})",
            "/materials/m/base_color_texture/image", "text.png");
    refused(R"("images": {"x": "text.png"})", "/images/x", "PNG");
    refused(R"("camera": "main", "nodes": [{"name": "eye", "camera": {}}])", "/camera", "eye");
    refused(R"("camera": "main", "cameras": {"main": {}})", "/camera", "no camera");

    write("broken.gltf", R"({"asset": {"version": "1.0"}})");
    EXPECT_EQ(find_refusal([&] { load_scene(write_scene(R"("include": "broken.gltf")")); }).file,
              (folder_ / "broken.gltf").string());
}

TEST_F(LoadScene, EndingsOfNamesCountInAnyCase) {
    for (const char* name : {"old.abc", "old.Abc", "old.ABC"}) {
        const fs::path file = write(name, "\x89HDF\r\n");
        for (const fs::path& path : {file, write_scene(fmt::format("\"include\": \"{}\"", name))}) {
            const Refusal found = find_refusal([&] { load_scene(path); });
            EXPECT_NE(found.reason.find("abcconvert"), std::string::npos) << name << ": " << found.message;
        }
    }
}

TEST_F(LoadScene, SaveIsAllOrNothing) {
    Scene scene;
    scene.source.name = "first";
    save_scene(scene, folder_ / "s.json");
    scene.film.exposure = not_a_number;
    EXPECT_THROW(save_scene(scene, folder_ / "s.json"), InputError);
    EXPECT_EQ(load_scene(folder_ / "s.json").source.name, "first");
    scene.film.exposure.reset();
    EXPECT_THROW(save_scene(scene, folder_ / "no/such/folder/s.json"), OutputError);
    EXPECT_THROW(save_scene(scene, folder_ / "s.abc"), InputError);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);  // lib and s.json: nothing left over
}

}  // namespace
}  // namespace aleph
