// A format of the test's own, added by one row of the table: everything that knows formats knows it.

#include "engine/load/scene_format.h"
#include "engine/base/files.h"
#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

/// A .tri file holds the nine coordinates of a triangle, and the name of a picture that has to be there.
FileTiming append_triangle(const AppendRequest& request, Scene& scene) {
    const Bytes bytes = read_regular_file(request.path, request.path.string(), "");
    std::istringstream words(std::string(bytes.begin(), bytes.end()));
    Scene part;
    Mesh& mesh = part.meshes.emplace_back();
    std::vector<glm::vec3> points(3);
    for (glm::vec3& point : points) words >> point.x >> point.y >> point.z;
    if (!words) throw InputError(request.path.string(), "", "a triangle has nine coordinates");
    mesh.positions = points;
    mesh.triangles = {{0, 1, 2}};
    part.nodes.emplace_back().meshes = {0};
    append_part(scene, std::move(part), request.parent_node, request.include);
    FileTiming timing;
    timing.frame_rate = FrameRate{12, 1};
    return timing;
}

std::vector<std::string> save_triangle(const Scene& scene, const fs::path& path) {
    std::ofstream file(path);
    for (const glm::vec3& p : scene.meshes.at(0).positions) file << p.x << ' ' << p.y << ' ' << p.z << '\n';
    return {};
}

void list_missing_pictures(const LoadRequest& request, std::vector<MissingFile>& missing) {
    missing.push_back({request.file, "10", "picture.png"});
}

SceneFormats formats_with_triangles() {
    SceneFormats formats = scene_formats();
    SceneFormat& triangles = formats.emplace_back();
    triangles.endings = {".tri"};
    triangles.description = "a triangle";
    triangles.append = append_triangle;
    triangles.save = save_triangle;
    triangles.list_missing = list_missing_pictures;
    return formats;
}

class SceneFormatRow : public LoadScene {
  protected:
    void SetUp() override {
        LoadScene::SetUp();
        write("one.tri", "0 0 0  1 0 0  0 1 0");
    }
    std::string refused(const fs::path& path) const {
        return find_refusal([&] { load_scene(path, {}, formats_); }).reason;
    }

    const SceneFormats formats_ = formats_with_triangles();
};

TEST_F(SceneFormatRow, IsLoadedAlone) {
    const Scene scene = load_scene(folder_ / "one.tri", {}, formats_);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.source.name, "one");
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{12, 1}));
    EXPECT_EQ(scene.cameras.size(), 1u) << "a camera is added, as for the other formats";
}

TEST_F(SceneFormatRow, IsIncluded) {
    const Scene scene = load_scene(
        write_scene(R"("nodes": [{"include": "one.tri"}, {"include": {"file": "one.tri", "up": "z", "scale": 2}}])"),
        {}, formats_);
    EXPECT_EQ(scene.source.includes.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 2u);
    const std::string reason =
        refused(write_scene(R"("nodes": [{"include": {"file": "one.tri", "animation": "walk"}}])"));
    EXPECT_EQ(reason, "a triangle has no animations to choose from");
}

TEST_F(SceneFormatRow, IsSavedAndReadAgain) {
    const Scene scene = load_scene(folder_ / "one.tri", {}, formats_);
    save_scene(scene, folder_ / "two.tri", formats_);
    EXPECT_EQ(load_scene(folder_ / "two.tri", {}, formats_).meshes, scene.meshes);
    EXPECT_THROW(save_scene(scene, folder_ / "two.abc", formats_), InputError);
    EXPECT_THROW(save_scene(scene, folder_ / "three.tri"), InputError) << "the table itself stays as it is";
}

TEST_F(SceneFormatRow, IsNamedByMessagesAndHelpTexts) {
    EXPECT_EQ(list_endings(scene_formats(), FormatUse::load), ".json, .gltf, .glb or .abc");
    EXPECT_EQ(list_endings(scene_formats(), FormatUse::include), ".gltf, .glb or .abc");
    EXPECT_EQ(list_endings(scene_formats(), FormatUse::save), ".json or .glb");
    EXPECT_EQ(list_endings(formats_, FormatUse::load), ".json, .gltf, .glb, .abc or .tri");
    EXPECT_EQ(list_endings(formats_, FormatUse::save), ".json, .glb or .tri");
    EXPECT_NE(refused(write("a.obj", "")).find("expected a .json, .gltf, .glb, .abc or .tri file"), std::string::npos);
    EXPECT_NE(refused(write_scene(R"("include": "a.obj")")).find("expected a .gltf, .glb, .abc or .tri file"),
              std::string::npos);
}

TEST_F(SceneFormatRow, ListsWhatIsMissing) {
    const auto missing = list_missing_files(write_scene(R"("include": ["one.tri", "two.tri"])"), {}, formats_);
    ASSERT_EQ(missing.size(), 2u);
    EXPECT_EQ(missing[0].path, "picture.png");
    EXPECT_EQ(missing[1].path, "two.tri");
}

}  // namespace
}  // namespace aleph
