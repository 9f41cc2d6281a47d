// Whole files: each loads, or is refused for the reason given.
#include "tests/engine/gltf/model_files.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {
namespace {

class GltfFiles : public testing::TestWithParam<ModelFile> {};

TEST_P(GltfFiles, LoadOrAreRefused) {
    const auto& [path, warnings, refused_for] = GetParam();
    try {
        const Scene scene = load_model(path);
        EXPECT_EQ(refused_for, "");
        EXPECT_EQ(scene.source.warnings.size(), warnings.size()) << testing::PrintToString(scene.source.warnings);
        for (const std::string& word : warnings) {
            EXPECT_TRUE(has_warning(scene, word)) << word;
        }
    } catch (const InputError& error) {
        ASSERT_NE(refused_for, "") << error.what();
        EXPECT_NE(error.reason().find(refused_for), std::string::npos) << error.what();
        EXPECT_EQ(error.file(), path.string());
    }
}

INSTANTIATE_TEST_SUITE_P(All, GltfFiles, testing::ValuesIn(model_files(false)),
                         [](const auto& file) { return model_name(file.param.path); });

/// The list has the whole folder. Without the folder, this is the one test that says so.
TEST(GltfForeignFiles, AreAllListed) {
    if (!std::filesystem::exists(foreign_models())) GTEST_SKIP() << missing_asset(foreign_models());
    std::vector<std::filesystem::path> listed, found;
    for (const ModelFile& file : foreign_model_files()) listed.push_back(file.path);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(foreign_models()))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") found.push_back(entry.path());
    std::ranges::sort(listed);
    std::ranges::sort(found);
    EXPECT_EQ(found, listed);
}

}  // namespace
}  // namespace aleph
