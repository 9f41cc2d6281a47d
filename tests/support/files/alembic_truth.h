#pragma once
// Archives and the values that the reference library reads from them. The project's own archives are in
// tests/assets/abc, others in assets_folder(), which may be absent.

#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {

using nlohmann::json;

inline const std::vector<std::string> own_archives{"camera_anim",   "instances",    "materials_facesets",
                                                   "polymesh_anim", "property_zoo", "subd_creases",
                                                   "xform_acyclic", "xform_uniform"};
inline const std::vector<std::string> foreign_archives{"indexedTextureCoordinates", "nestedInstancing", "testAbcCamera",
                                                       "testUsdAbcXformPrimCollapsing"};

inline std::filesystem::path archive_path(const std::string& name) {
    const std::filesystem::path own = own_assets_folder() / "abc" / (name + ".abc");
    if (std::filesystem::exists(own)) return own;
    return assets_folder() / "abc/third_party" / (name + ".abc");
}

inline json truth_of(const std::string& name) {
    std::ifstream stream(archive_path(name).replace_extension(".json"));
    return json::parse(stream);
}

inline const json& object_of(const json& truth, const std::string& path) {
    for (const json& object : truth["objects"])
        if (object["path"] == path) return object;
    throw std::out_of_range("no object " + path);
}

/// Tests with a parameter: the name of an archive.
class AlembicTruth : public testing::TestWithParam<std::string> {
  protected:
    const json truth = truth_of(GetParam());
};

/// Our own, and the others that are there.
inline std::vector<std::string> all_archives() {
    std::vector<std::string> names = own_archives;
    for (const std::string& name : foreign_archives)
        if (std::filesystem::exists(archive_path(name))) names.push_back(name);
    return names;
}

}  // namespace aleph
