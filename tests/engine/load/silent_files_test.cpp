// Files that load and show less than they seem to: each gets one warning that names the place, or is refused.

#include <gmock/gmock.h>

#include "engine/load/load_scene.h"
#include "tests/support/files/gltf_bad_input.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A triangle with a texture, a light and a camera: it loads without a warning.
GltfDraft quiet_draft(const ScratchFolder& folder) {
    GltfDraft draft = textured_draft(folder, false);
    draft.json.erase("animations");
    draft.primitive()["attributes"]["TEXCOORD_0"] = draft.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    return draft;
}

/// Replaces the three corners (accessor 1) by others.
void set_corners(GltfDraft& draft, const std::vector<float>& corners) {
    draft.primitive()["attributes"]["POSITION"] = draft.add_accessor(corners, "VEC3", 3);
}

Json diagonal(double scale) {
    return {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1};
}

class SilentFiles : public testing::Test {
  protected:
    Scene load(GltfDraft draft) {
        write_text(path_, draft.to_text());
        return load_scene(path_);
    }
    void expect_one_warning(GltfDraft draft, const std::string& place, const std::string& words) {
        const Scene scene = load(std::move(draft));
        ASSERT_EQ(scene.source.warnings.size(), 1u) << testing::PrintToString(scene.source.warnings);
        EXPECT_THAT(scene.source.warnings[0], HasSubstr(path_.string() + ": " + place));
        EXPECT_THAT(scene.source.warnings[0], HasSubstr(words));
    }
    /// The draft after a change gives no warning either.
    void expect_quiet(const std::function<void(GltfDraft&)>& change) {
        GltfDraft draft = quiet_draft(folder_);
        change(draft);
        EXPECT_THAT(load(draft).source.warnings, testing::IsEmpty());
    }
    void expect_refused(GltfDraft draft, const std::string& place, const std::string& words) {
        expect_refusal([&] { load(std::move(draft)); }, path_.string(), place, words);
    }

    ScratchFolder folder_;
    fs::path path_ = folder_ / "scene.gltf";
};

TEST_F(SilentFiles, TheDraftLoadsWithoutAWarning) {
    EXPECT_THAT(load(quiet_draft(folder_)).source.warnings, testing::IsEmpty());
}

TEST_F(SilentFiles, MeshesWithoutAnArea) {
    const std::vector<std::vector<float>> degenerate = {
        {0, 0, 0, 0, 0, 0, 0, 0, 0},  // all zero
        {1, 2, 3, 1, 2, 3, 5, 6, 7},  // two corners coincide
        {0, 0, 0, 1, 2, 3, 2, 4, 6},  // on a line
        {1e6f, 0, 0, 2e6f, 0, 0, -3e6f, 0, 0},
    };
    for (const std::vector<float>& corners : degenerate) {
        SCOPED_TRACE(testing::PrintToString(corners));
        GltfDraft draft = quiet_draft(folder_);
        set_corners(draft, corners);
        expect_one_warning(draft, "mesh \"mesh0\"", "no triangle has an area");
    }
    GltfDraft one_index = quiet_draft(folder_);
    one_index.primitive()["indices"] = one_index.add_accessor<std::uint16_t>({1, 1, 1}, "SCALAR", 1);
    expect_one_warning(one_index, "mesh \"mesh0\"", "no triangle has an area");
    GltfDraft strip = quiet_draft(folder_);
    strip.primitive()["indices"] = strip.add_accessor<std::uint16_t>({0, 0, 1, 1}, "SCALAR", 1);
    strip.primitive()["mode"] = 5;
    expect_one_warning(strip, "mesh \"mesh0\"", "no triangle has an area");
    GltfDraft several = quiet_draft(folder_);
    set_corners(several, degenerate[0]);
    several.json["meshes"][0]["primitives"].push_back(several.primitive());
    expect_one_warning(several, "mesh \"mesh0.0\" and 1 more", "no triangle has an area");
}

TEST_F(SilentFiles, RC09_SomeTrianglesWithoutAnArea) {
    GltfDraft draft = quiet_draft(folder_);
    draft.primitive()["indices"] = draft.add_accessor<std::uint16_t>({0, 1, 2, 1, 1, 1, 0, 2, 2}, "SCALAR", 1);
    expect_one_warning(draft, "mesh \"mesh0\"", "2 of the triangles have no area");
    draft.json["meshes"][0]["primitives"].push_back(draft.primitive());
    expect_one_warning(draft, "mesh \"mesh0.0\" and 1 more", "4 of the triangles have no area");
}

TEST_F(SilentFiles, SmallOrThinOrMovingMeshesAreNoReasonToWarn) {
    for (const std::vector<float>& corners :
         {std::vector<float>{0, 0, 0, 1e-20f, 0, 0, 0, 1e-20f, 0}, {0, 0, 0, 1, 0, 0, 1, 1e-6f, 0}}) {
        expect_quiet([&](GltfDraft& d) { set_corners(d, corners); });
    }
    expect_quiet([&](GltfDraft& d) {
        const int moves = d.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
        set_corners(d, std::vector<float>(9, 0.0f));
        d.primitive()["targets"] = {{{"POSITION", moves}}};
    });
    expect_quiet([&](GltfDraft& d) {
        Json flat = d.json["meshes"][0];
        flat["primitives"][0]["indices"] = d.add_accessor<std::uint16_t>({1, 1, 1}, "SCALAR", 1);
        d.json["meshes"].push_back(flat);
    });
}

TEST_F(SilentFiles, ASceneWithoutAMesh) {
    GltfDraft draft = quiet_draft(folder_);
    draft.json["nodes"][1].erase("mesh");
    expect_one_warning(draft, "/scenes/0", "no node of the scene has a mesh");
    GltfDraft elsewhere = quiet_draft(folder_);  // the mesh stands in a scene that is not read
    elsewhere.json["nodes"][0]["children"] = {2};
    elsewhere.json["scenes"].push_back({{"nodes", {1}}});
    const Scene scene = load(elsewhere);
    ASSERT_EQ(scene.source.warnings.size(), 2u);
    EXPECT_THAT(scene.source.warnings[0], HasSubstr("of 2 scenes only the default one is read"));
    EXPECT_THAT(scene.source.warnings[1], HasSubstr("/scenes/0: no node of the scene has a mesh"));
}

TEST_F(SilentFiles, NodesThatShrinkTheirMeshesToAPoint) {
    for (const double scale : {0.0, 1e-20, -1e-20}) {
        SCOPED_TRACE(scale);
        GltfDraft matrix = quiet_draft(folder_);
        matrix.json["nodes"][1] = {{"mesh", 0}, {"matrix", diagonal(scale)}};
        expect_one_warning(matrix, "node \"node1\"", "the scale is 0, or next to it, along an axis");
        GltfDraft scaled = quiet_draft(folder_);
        scaled.json["nodes"][1]["scale"] = {scale, scale, scale};
        expect_one_warning(scaled, "node \"node1\"", "the scale is 0, or next to it, along an axis");
    }
    GltfDraft flat = quiet_draft(folder_);
    flat.json["nodes"][1]["scale"] = {1, 1, 0};
    expect_one_warning(flat, "node \"node1\"", "the scale is 0, or next to it, along an axis");
    // Small, without a mesh, or keyed: no reason to warn.
    expect_quiet([&](GltfDraft& d) { d.json["nodes"][1]["scale"] = {1e-6, 1e-6, 1e-6}; });
    expect_quiet([&](GltfDraft& d) {
        d.json["nodes"].push_back({{"scale", {0, 0, 0}}});
        d.json["nodes"][0]["children"].push_back(3);
    });
    expect_quiet([&](GltfDraft& d) {
        d.json["nodes"][1]["scale"] = {0, 0, 0};
        d.animate(1, "scale", {0, 1}, {0, 0, 0, 1, 1, 1});
    });
}

TEST_F(SilentFiles, TexturesWithoutTheirCoordinates) {
    GltfDraft draft = quiet_draft(folder_);
    draft.primitive()["attributes"].erase("TEXCOORD_0");
    expect_one_warning(draft, "mesh \"mesh0\"",
                       "no texture coordinates 0 for the base_color_texture of material \"material0\"");
    GltfDraft second = quiet_draft(folder_);
    second.json["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    expect_one_warning(second, "mesh \"mesh0\"", "no texture coordinates 1 for the emission_texture");
}

TEST_F(SilentFiles, TextureCoordinatesThatSinglePrecisionCannotUse) {
    for (const float huge : {1e30f, -1e30f, std::numeric_limits<float>::max()}) {
        GltfDraft draft = quiet_draft(folder_);
        draft.primitive()["attributes"]["TEXCOORD_0"] = draft.add_accessor<float>({0, 0, huge, 0, 0, 1}, "VEC2", 2);
        expect_one_warning(draft, "mesh \"mesh0\"", "texture coordinates go beyond 1e+06");
    }
    GltfDraft infinite = quiet_draft(folder_);
    infinite.primitive()["attributes"]["TEXCOORD_0"] =
        infinite.add_accessor<float>({0, 0, float_infinity, 0, 0, 1}, "VEC2", 2);
    expect_refused(infinite, "/accessors/" + std::to_string(infinite.json["accessors"].size() - 1), "must be finite");
}

TEST_F(SilentFiles, CamerasWithoutADirectionAreRefused) {
    const std::string reason = "looks in no direction";
    GltfDraft own = quiet_draft(folder_);
    own.json["nodes"][2]["scale"] = {0, 0, 0};
    expect_refused(own, "node \"node2\"", reason);
    GltfDraft above = quiet_draft(folder_);
    above.json["nodes"][0]["matrix"] = diagonal(0.0);
    expect_refused(above, "node \"node2\"", reason);
    GltfDraft line = quiet_draft(folder_);
    line.json["nodes"][2]["scale"] = {0, 0, 1};
    expect_refused(line, "node \"node2\"", reason);
    // A scale does not matter to a camera as long as its axes can be told, or as it moves away from 0.
    expect_quiet([&](GltfDraft& d) { d.json["nodes"][2]["scale"] = {1e-20, 1e-20, 1e-20}; });
    expect_quiet([&](GltfDraft& d) { d.json["nodes"][2]["scale"] = {1, 0, 1}; });
    expect_quiet([&](GltfDraft& d) { d.animate(2, "scale", {0, 1}, {0, 0, 0, 1, 1, 1}); });

    write_text(folder_ / "scene.json", R"({"aleph": 1, "environment": [1, 1, 1], "nodes": [
        {"name": "rig", "scale": 0, "children": [{"name": "eye", "camera": {"fov": 45}}]}]})");
    const fs::path file = folder_ / "scene.json";
    expect_refusal([&] { load_scene(file); }, file.string(), "node \"eye\"", "");
}

TEST_F(SilentFiles, FieldsOfViewThatSinglePrecisionCannotUseAreRefused) {
    GltfDraft draft = quiet_draft(folder_);
    draft.json["cameras"][0]["perspective"]["yfov"] = 1e-9;
    expect_refused(draft, "/cameras/0/perspective/yfov", "must be at least 1e-06 radians, found 1e-09");
    draft.json["cameras"][0]["perspective"]["yfov"] = 1e-6;
    EXPECT_THAT(load(draft).source.warnings, testing::IsEmpty());
}

}  // namespace
}  // namespace aleph
