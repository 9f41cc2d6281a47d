// The environment's picture as load_scene brings it, and what is said of surfaces that need texture coordinates.

#include "engine/image/image_file.h"
#include "engine/load/load_scene.h"
#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

using LoadEnvironment = LoadScene;

void write_sky(const fs::path& path, const Image<float>& red) {
    write_exr(path, {{{"R", red}, {"G", Image<float>(red.width, red.height, 2.0f)}, {"B", red}}, {}});
}

TEST_F(LoadEnvironment, APictureIsLightAndIsDecodedAsItIs) {
    Image<float> red(4, 2, 0.5f);
    red(0, 0) = -3.0f;
    red(1, 0) = 60000.0f;
    red(2, 0) = float_nan;
    write_sky(folder_ / "lib/sky.exr", red);
    const Scene scene = load_scene(write_scene(R"("environment_image": "lib/sky.exr")"));
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
    ASSERT_EQ(scene.images.size(), 1u);
    const SceneImage& sky = scene.images[scene.environment.image];
    EXPECT_TRUE(sky.bytes.empty());
    ASSERT_EQ(sky.floats.width, 4);
    EXPECT_EQ(sky.floats(0, 0), glm::vec4(-3.0f, 2.0f, -3.0f, 1.0f));
    EXPECT_EQ(sky.floats(1, 0).x, 60000.0f);
    EXPECT_TRUE(std::isnan(sky.floats(2, 0).x));
    EXPECT_EQ(scene.environment.radiance, Track<glm::dvec3>(glm::dvec3(1.0)));
}

TEST_F(LoadEnvironment, SaveKeepsThePictureAndItsRotation) {
    write_sky(folder_ / "sky.exr", Image<float>(4, 2, 0.5f));
    const Scene scene = load_scene(write_scene(R"("environment_image": "sky.exr", "environment": [3, 2, 1],
        "environment_rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [30, 360]]}}, "viewing": {"persistence": 0.25})"));
    expect_saved_and_loaded_alike(scene);
    save_scene(scene, folder_ / "lib/moved.json");
    const Scene moved = load_scene(folder_ / "lib/moved.json");
    EXPECT_EQ(moved.images[moved.environment.image].path, "../sky.exr");
    EXPECT_EQ(moved.images[0].floats, scene.images[0].floats);
}

TEST_F(LoadEnvironment, ColoursOfEightBitsBecomeRadiance) {
    Image<Rgb> picture(2, 1, Rgb(1.0f));
    picture(1, 0) = Rgb(0.0f, 0.5f, 1.0f);
    write_png(folder_ / "sky.png", picture);
    const Scene scene = load_scene(write_scene(R"("environment_image": "sky.png")"));
    const SceneImage& sky = scene.images[scene.environment.image];
    EXPECT_TRUE(sky.bytes.empty());
    EXPECT_EQ(sky.floats(0, 0), glm::vec4(1.0f));
    EXPECT_EQ(sky.floats(1, 0).x, 0.0f);
    // 0.5 is the byte 188 in sRGB: ((188 / 255 + 0.055) / 1.055)^2.4 = 0.50289.
    EXPECT_NEAR(sky.floats(1, 0).y, 0.50289, 1e-5);
}

TEST_F(LoadEnvironment, APictureThatIsATextureTooIsThereTwice) {
    write_png(folder_ / "sky.png", Image<Rgb>(2, 1, Rgb(0.5f)));
    const Scene scene = load_scene(write_scene(R"("images": {"sky": "sky.png"}, "environment_image": "sky",
        "materials": {"m": {"metallic_roughness_texture": "sky", "base_color_texture": "sky.png"}})"));
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(scene.environment.image, 1);
    EXPECT_EQ(scene.images[1].name, "sky 2");
    EXPECT_EQ(scene.images[1].path, "sky.png");
    EXPECT_FALSE(scene.images[1].floats.empty());
    EXPECT_EQ(scene.materials[0].textures[TextureSlot::metallic_roughness].image, 0);
    EXPECT_EQ(scene.images[0].bytes(0, 0), glm::u8vec4(188, 188, 188, 255));
    expect_saved_and_loaded_alike(scene);
}

TEST_F(LoadEnvironment, TexelsThatAreNoLightCountAsZero) {
    ChannelImage image;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, Image<float>(2, 2, 0.5f)});
    image.channels[0].values(0, 0) = nan;
    image.channels[1].values(1, 0) = -infinite;
    image.channels[2].values(1, 0) = -1e-6f;
    write_exr(folder_ / "t.exr", image);
    const Scene scene = load_scene(write_scene(R"("materials": {"m": {"base_color_texture": "t.exr"}})"));
    EXPECT_TRUE(has_warning(scene, "t.exr: 2 texels of 4 are below 0, NaN or infinite there, and count as 0"));
    const Image<glm::vec4>& texels = scene.images.at(0).floats;
    EXPECT_EQ(texels(0, 0), glm::vec4(0.0f, 0.5f, 0.5f, 1.0f));
    EXPECT_EQ(texels(1, 0), glm::vec4(0.5f, 0.0f, 0.0f, 1.0f));
    EXPECT_EQ(texels(1, 1), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
}

TEST_F(LoadEnvironment, ALightBeyondTheRangeOfItsFileIsMissed) {
    Image<float> red(4, 2, 0.5f);
    red(1, 0) = std::numeric_limits<float>::infinity();
    write_sky(folder_ / "sky.exr", red);
    EXPECT_TRUE(
        has_warning(load_scene(write_scene(R"("environment_image": "sky.exr")")),
                    "sky.exr: 1 texels of 8 are infinite there, and count as 0: its brightest light is missing"));
}

/// OpenEXR's colours are multiplied by alpha. A surface's are not, but the light of the surroundings is.
TEST_F(LoadEnvironment, ColoursOfAnExrAreDividedByItsAlpha) {
    ChannelImage image;
    for (const char* name : {"R", "G", "B", "A"}) image.channels.push_back({name, Image<float>(3, 1, 0.25f)});
    image.channels[3].values.pixels = {0.5f, 1.0f, 0.0f};
    write_exr(folder_ / "t.exr", image);
    const Scene card = load_scene(write_scene(R"("materials": {"m": {"base_color_texture": "t.exr"}})"));
    EXPECT_EQ(card.images.at(0).floats.pixels,
              (std::vector<glm::vec4>{glm::vec4(0.5f), {0.25f, 0.25f, 0.25f, 1.0f}, {0.25f, 0.25f, 0.25f, 0.0f}}));
    const Scene sky = load_scene(write_scene(R"("environment_image": "t.exr")"));
    EXPECT_EQ(sky.images.at(0).floats(0, 0), glm::vec4(0.25f, 0.25f, 0.25f, 0.5f));
}

TEST_F(LoadEnvironment, PicturesThatCannotBeReadAreRefused) {
    const auto refused = [&](const std::string& body, const std::string& place, const std::string& word) {
        expect_refused(write_scene(body), place, word);
    };
    write("sky.txt", "blue above");
    fs::create_directories(folder_ / "sky.exr");
    refused(R"("environment_image": "gone.exr")", "/environment_image", "there is no file");
    refused(R"("environment_image": "sky.txt")", "/environment_image", "not a PNG, JPEG, EXR or HDR picture");
    refused(R"("environment_image": "sky.exr")", "/environment_image", "not a regular file");
    refused(R"("images": {"sky": "gone.hdr"}, "environment_image": "sky")", "/images/sky", "there is no file");
}

TEST_F(LoadEnvironment, RotationKeysFarApartAreSaid) {
    write_sky(folder_ / "sky.exr", Image<float>(4, 2, 0.5f));
    const auto load = [&](const std::string& rotation) {
        return load_scene(write_scene("\"environment_image\": \"sky.exr\", \"environment_rotation\": " + rotation));
    };
    EXPECT_TRUE(has_warning(load(R"({"keys": [[0, [0, 0, 0, 1]], [5, [0, 1, 0, 0]]]})"),
                            "environment_rotation: neighbouring rotation keys are 180 degrees apart"));
    EXPECT_TRUE(has_warning(load("[0, 0, 0, 2]"), "environment_rotation: rotation key 0 has length 2"));
    EXPECT_TRUE(load(R"({"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [5, 720]]}})").source.warnings.empty());
}

class LoadDirections : public LoadScene {
  protected:
    /// Warnings of a triangle with such a material and such further keys of its mesh.
    std::vector<std::string> warnings_of(const std::string& material, const std::string& mesh = "") {
        write_png(folder_ / "p.png", Image<Rgb>(1, 1));
        return load_scene(write_scene(R"("environment": [1, 1, 1], "materials": {"m": {)" + material +
                                      R"(}}, "nodes": [{"name": "leaf", "material": "m", "shape": {"type": "mesh",
                                      "positions": [0, 0, 0, 1, 0, 0, 0, 1, 0], "triangles": [0, 1, 2])" +
                                      mesh + "}}]"))
            .source.warnings;
    }
    static constexpr const char* uv = ", \"uv\": [0, 0, 1, 0, 0, 1]";
};

TEST_F(LoadDirections, NormalMapsAndAnisotropyNeedTextureCoordinates) {
    const std::vector<std::string> normal = {
        "mesh \"leaf\": no texture coordinates 0 for the normal_texture of material \"m\"; it has no effect there"};
    EXPECT_EQ(warnings_of(R"("normal_texture": "p.png")"), normal);
    EXPECT_EQ(warnings_of(R"("normal_texture": "p.png", "anisotropy": 0.5)"), normal) << "one warning for both";
    EXPECT_TRUE(warnings_of(R"("normal_texture": "p.png", "anisotropy": 0.5)", uv).empty());
    EXPECT_EQ(
        warnings_of(R"("anisotropy": {"keys": [[0, 0], [9, 0.5]]})"),
        (std::vector<std::string>{
            "mesh \"leaf\": no texture coordinates 0 for the anisotropy of material \"m\"; it has no effect there"}));
    EXPECT_TRUE(warnings_of(R"("anisotropy": 0.5)", uv).empty());
    EXPECT_TRUE(warnings_of(R"("anisotropy": 0)").empty());
    EXPECT_EQ(warnings_of(R"("clearcoat_normal_texture": {"image": "p.png", "uv_set": 1})", uv),
              (std::vector<std::string>{"mesh \"leaf\": no texture coordinates 1 for the clearcoat_normal_texture of "
                                        "material \"m\"; it has no effect there"}));
}

TEST_F(LoadDirections, OtherTexturesHaveTheirOwnWarning) {
    EXPECT_EQ(warnings_of(R"("normal_texture": "p.png", "sheen_color_texture": "p.png")").size(), 2u);
    EXPECT_EQ(warnings_of(R"("sheen_color_texture": "p.png")"),
              (std::vector<std::string>{"mesh \"leaf\": no texture coordinates 0 for the sheen_color_texture of "
                                        "material \"m\"; one texel of the picture colours all of it"}));
}

}  // namespace
}  // namespace aleph
