#pragma once
// The file that the bad-input tests of the glTF reader break, and how a refusal must look.

#include "engine/gltf/gltf.h"
#include "engine/image/image_file.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {

/// A scene with one of everything; accessors: 0 indices, 1 positions, 2 normals, 3 colours, 4 key times, 5 rotations.
inline GltfDraft full_draft() {
    GltfDraft draft = triangle_draft();
    Json& attributes = draft.primitive()["attributes"];
    attributes["NORMAL"] = draft.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    attributes["COLOR_0"] = draft.add_accessor<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "VEC4", 4, true);
    draft.json["nodes"] = {{{"name", "a"}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 0, 1}}},
                           {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    draft.animate(1, "rotation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0, 1, 0});
    draft.animate(1, "translation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0});
    draft.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    draft.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_specular"};
    draft.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"color", {1, 1, 1}}}};
    draft.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}}},
                                {"emissiveFactor", {0, 0, 0}},
                                {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}};
    draft.primitive()["material"] = 0;
    return draft;
}

/// full_draft with a texture on the material, the image being a view or a file.
inline GltfDraft textured_draft(const ScratchFolder& folder, bool from_file) {
    GltfDraft draft = full_draft();
    write_png(folder / "image.png", Image<Rgb>(2, 2, Rgb(1.0f)));
    const Bytes encoded = read_regular_file(folder / "image.png", "image.png", "");
    if (from_file) {
        draft.json["images"] = {{{"uri", "image.png"}}};
    } else {
        draft.json["images"] = {{{"bufferView", draft.add_view(encoded)}, {"mimeType", "image/png"}}};
    }
    draft.json["samplers"] = {Json::object()};
    draft.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    draft.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return draft;
}

/// Makes so many root nodes like this one the only nodes.
inline void repeat_node(GltfDraft& draft, int times, const Json& node) {
    Json roots = Json::array();
    for (int i = 0; i < times; ++i) roots.push_back(i);
    draft.json["nodes"] = std::vector<Json>(static_cast<std::size_t>(times), node);
    draft.json["scenes"][0]["nodes"] = roots;
}

/// Expects this place and reason within the limits, and an unchanged scene.
inline void expect_refused(const std::filesystem::path& path, const std::string& place, const std::string& reason) {
    Scene scene;
    scene.nodes.resize(1);
    const Scene before = scene;
    const LoadCost cost = load_cost([&] { append_gltf(path, scene, 0, 0); });
    expect_refusal(cost.refusal, path.string(), place, reason);
    EXPECT_LT(cost.refusal.message.size(), 1000u);
    expect_bounded(cost, path.string());
    EXPECT_EQ(scene, before);
}

}  // namespace aleph
