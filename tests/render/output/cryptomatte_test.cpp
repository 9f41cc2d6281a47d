// Files for other programs: Cryptomatte, importance as one picture.

#include <bit>
#include <nlohmann/json.hpp>

#include "engine/pose/pose.h"
#include "render/output/frame_files.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Cryptomatte, HashesAreMurmur3) {
    EXPECT_EQ(murmur_hash(""), 0u);
    EXPECT_EQ(murmur_hash("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog."), 0xd5c48bfcu);
}

TEST(Cryptomatte, IdsAreNormalFloats) {
    EXPECT_EQ(cryptomatte_id("hello"), 6.0705627102400005616e-17f);
    for (int i = 0; i < 2000; ++i) EXPECT_TRUE(std::isnormal(cryptomatte_id(std::to_string(i)))) << i;
}

TEST(Cryptomatte, FilesNameTheObjectsOfTheirPixels) {
    Scene scene;
    scene.meshes.resize(1);
    Node node{.name = "table"};
    scene.nodes.push_back(node);
    node.meshes = {0};
    node.parent = 0;
    node.name = "cup";
    scene.nodes.push_back(node);
    FrameOutput output;
    output.hits = Image<Hit>(2, 1);
    output.hits.pixels[1].instance = 0;
    const ChannelImage file = make_frame_image(output, true, scene, RenderSettings(), 1.0);
    EXPECT_EQ(file.find("CryptoObject00.r")->pixels, (std::vector<float>{0.0f, cryptomatte_id("/table/cup")}));
    EXPECT_EQ(file.find("CryptoObject00.g")->pixels, (std::vector<float>{0.0f, 1.0f}));
    const std::string prefix = cryptomatte_prefix("CryptoObject");
    EXPECT_EQ(prefix.size(), std::string("cryptomatte/1234567/").size());
    const auto text = [&](const char* key) { return std::get<std::string>(file.metadata.at(prefix + key)); };
    EXPECT_EQ(text("name"), "CryptoObject");
    EXPECT_EQ(text("hash"), "MurmurHash3_32");
    EXPECT_EQ(text("conversion"), "uint32_to_float32");
    const auto manifest = nlohmann::json::parse(text("manifest"));
    ASSERT_EQ(manifest.size(), 1u);
    const auto bits = static_cast<std::uint32_t>(std::stoul(manifest["/table/cup"].get<std::string>(), nullptr, 16));
    EXPECT_EQ(std::bit_cast<float>(bits), file.find("CryptoObject00.r")->pixels[1]);
}

TEST(Importance, IsOneWhereViewersAreStrictest) {
    Image<float> aleph(3, 1);
    aleph.pixels = {1.0f, 4.0f, 250.6f};
    const Image<float> importance = make_importance(aleph);
    EXPECT_EQ(importance.pixels, (std::vector<float>{1.0f, 0.25f, 1.0f / 250.6f}));
}

}  // namespace
}  // namespace aleph
