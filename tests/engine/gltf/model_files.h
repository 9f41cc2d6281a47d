#pragma once
// The glTF files of tests/assets/gltf, and those that other programs wrote, where they are there.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "engine/gltf/gltf.h"
#include "tests/support/paths.h"

namespace aleph {

struct ModelFile {
    std::filesystem::path path;
    std::vector<std::string> warnings;  ///< a word of each
    std::string refused_for;            ///< word in the message; empty: it loads
};

inline void PrintTo(const ModelFile& file, std::ostream* stream) {
    *stream << file.path;
}

inline std::filesystem::path own_model(const std::string& name) {
    return own_assets_folder() / "gltf" / name;
}

inline Scene load_model(const std::filesystem::path& path) {
    Scene scene;
    append_gltf(path, scene, no_index, 0);
    return scene;
}

inline std::vector<ModelFile> own_model_files() {
    std::vector<ModelFile> files{{own_model("recursive.glb"), {}, "cycle"},
                                 {own_model("skin.glb"),
                                  {"\"walk\" are left out: \"survey\" moves", "\"run\" are left out: \"survey\" moves"},
                                  ""},
                                 {source_folder() / "scenes/room/room.glb", {}, ""}};
    for (const char* name :
         {"interpolation.glb", "inverse_parent.glb", "lamp_box.glb", "morph_cube.glb", "sparse.glb", "truck.glb"})
        files.push_back({own_model(name), {}, ""});
    return files;
}

inline std::filesystem::path foreign_models() {
    return assets_folder() / "gltf";
}

inline std::vector<ModelFile> foreign_model_files() {
    std::vector<ModelFile> files{
        {"Cameras.gltf", {"the rotation quaternion has length 0.948683"}, ""},
        {"Fox.glb", {"\"Walk\" are left out: \"Survey\" moves", "\"Run\" are left out: \"Survey\" moves"}, ""},
        {"RecursiveNodes.gltf", {}, "cycle"},
        {"09_texture_transform/09_texture_transform.gltf", {"occlusion textures (1) are not used"}, ""},
        {"box_sparse.glb", {"byteOffset means nothing"}, ""}};
    for (const char* name :
         {"06_parent-inverse-anim/06_parent-inverse-anim.gltf", "AnimatedMorphCube/AnimatedMorphCube.gltf",
          "BoxInterleaved.glb", "BoxVertexColors.glb", "CesiumMilkTruck.glb", "CompareRoughness.glb", "CornellBox.glb",
          "InterpolationTest/InterpolationTest.gltf", "OrientationTest.glb", "SimpleSkin.gltf",
          "TriangleWithoutIndices.gltf", "lightCameraAnimations/lightCameraAnimations.gltf"})
        files.push_back({name, {}, ""});
    for (ModelFile& file : files) file.path = foreign_models() / file.path;
    return files;
}

/// @param loaded  without those that are refused
inline std::vector<ModelFile> model_files(bool loaded) {
    std::vector<ModelFile> files = own_model_files();
    for (const ModelFile& file : foreign_model_files())
        if (std::filesystem::exists(file.path)) files.push_back(file);
    std::erase_if(files, [&](const ModelFile& file) { return loaded && !file.refused_for.empty(); });
    return files;
}

/// Those of these stems.
inline std::vector<ModelFile> model_files_named(const std::vector<std::string>& stems) {
    std::vector<ModelFile> files = model_files(true);
    std::erase_if(files, [&](const ModelFile& file) {
        return std::ranges::find(stems, file.path.stem().string()) == stems.end();
    });
    return files;
}

/// For names of tests.
inline std::string model_name(const std::filesystem::path& path) {
    std::string name = path.stem().string();
    std::ranges::replace_if(
        name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
}

}  // namespace aleph
