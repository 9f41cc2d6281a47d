// The page of a study: its layers, its data, and its size.
// The data of the viewer test.

#include <Imath/half.h>
#include <zlib.h>
#include <bit>

#include "engine/gltf/files.h"
#include "engine/image/image_file.h"
#include "render/study/pages/pages.h"
#include "tests/render/expect_fields.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Json = nlohmann::ordered_json;

std::vector<float> decode(const std::string& text, std::size_t count, LayerType type) {
    const std::size_t width = type == LayerType::f16 ? 2 : 4;
    const Bytes packed = decode_data_uri("data:;base64," + text, "", "");
    std::string bytes(count * width, '\0');
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(size, bytes.size());
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t bits = 0;
        for (std::size_t b = 0; b < width; ++b)
            bits |= std::uint32_t{static_cast<unsigned char>(bytes[b * count + i])} << (8 * b);
        if (type == LayerType::f32) {
            values.push_back(std::bit_cast<float>(bits));
        } else {
            Imath::half h;
            h.setBits(static_cast<std::uint16_t>(bits));
            values.push_back(h);
        }
    }
    return values;
}

TEST(ReportLayers, GiveBackWhatWasPutIn) {
    Image<float> a(5, 3), b(5, 3);
    for (std::size_t i = 0; i < a.size(); ++i) {
        a.pixels[i] = std::ldexp(1.0f + 0.1f * static_cast<float>(i), static_cast<int>(i) - 7);
        b.pixels[i] = -a.pixels[i];
    }
    b.pixels[3] = 1e9f;
    const std::vector<float> exact = decode(encode_layer({&a, &b}, LayerType::f32), 30, LayerType::f32);
    const std::vector<float> half = decode(encode_layer({&a, &b}, LayerType::f16), 30, LayerType::f16);
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_EQ(exact[i], a.pixels[i]);
        EXPECT_EQ(exact[15 + i], b.pixels[i]);
        EXPECT_NEAR(half[i], a.pixels[i], a.pixels[i] / 2048.0f);
    }
    EXPECT_EQ(half[18], 65504.0f) << "the largest half";
}

TEST(ReportLayers, KeepToTheirSize) {
    const Image<float> image(64, 64, 0.3f);
    const std::size_t one = encode_layer({&image}, LayerType::f32).size();
    ReportLayers layers(2 * one + one / 2);
    EXPECT_FALSE(layers.add({&image}, LayerType::f32).is_null());
    const Json second = layers.add({&image}, LayerType::f32);
    expect_fields(second, R"({"element": "layer-1", "width": 64, "type": "f32"})");
    EXPECT_TRUE(layers.add({&image}, LayerType::f32).is_null());
    EXPECT_EQ(layers.left_out(), 1u);
}

Json data_of(const std::string& page) {
    const std::string start = "<script id=\"study\" type=\"application/json\">";
    const std::size_t begin = page.find(start) + start.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

class ReportPage : public testing::Test {
  protected:
    ReportPage() {
        ChannelImage picture;
        std::uint32_t state = 1;
        for (const char* name : {"R", "G", "B", "samples.Y", "error.edges"}) {
            Image<float> values(32, 32);
            for (float& value : values.pixels)
                value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
            picture.channels.push_back({name, std::move(values)});
        }
        write_exr(folder / "picture.exr", picture);
        JudgingFrame& frame = results.frames.emplace_back();
        frame.scene = "noise";
        frame.frame = 7;
        frame.reference = folder / "picture.exr";
        frame.maps.channels.push_back({"threshold.Y", Image<float>(32, 32, 0.5f)});
        json = {{"title", "</script><b>"}, {"width", 32}, {"height", 32}, {"variants", Json::array()}};
        for (const char* name : {"worse", "better"}) {
            VariantResult& variant = results.variants.emplace_back();
            variant.name = name;
            variant.on_front = variant.name == "better";
            FrameResult& result = variant.frames.emplace_back();
            result.scene = "noise";
            result.frame = 7;
            result.picture = (folder / "picture.exr").string();
            json["variants"].push_back({{"id", name}, {"frames", {{{"scene", "noise"}, {"frame", 7}}}}});
        }
    }
    std::string make_page(std::size_t most_bytes = most_report_bytes) const {
        return make_report("<head><!-- STUDY DATA --></head><body><!-- STUDY LAYERS --></body>", json, results,
                           most_bytes);
    }

    const ScratchFolder folder;
    StudyResults results;
    Json json;
};

TEST_F(ReportPage, HoldsPicturesAndMaps) {
    const std::string page = make_page();
    const Json data = data_of(page);
    // A text does not end the script.
    expect_fields(
        data,
        R"({"title": "</script><b>", "frames": [7], "scene": "noise", "layers_left_out": 0, "display_white": 100})");
    EXPECT_EQ(data["pictures"][0]["maps"]["threshold.Y"]["channels"], 1);
    const Json picture = data["variants"][1]["frames"][0]["picture"];
    EXPECT_EQ(picture["channels"], 3);
    const std::string element = "id=\"" + picture["element"].get<std::string>() + "\">";
    const std::size_t begin = page.find(element) + element.size();
    const std::string text = page.substr(begin, page.find('<', begin) - begin);
    const ChannelImage stored = read_image(folder / "picture.exr");
    const std::vector<float> values = decode(text, 3 * 1024, LayerType::f32);
    EXPECT_TRUE(std::equal(values.begin(), values.begin() + 1024, stored.find("R")->pixels.begin()));
    EXPECT_TRUE(data["variants"][0]["frames"][0]["maps"].contains("error.edges"));
}

TEST_F(ReportPage, LeavesOutTheLeastNeededFirst) {
    const std::size_t whole = make_page().size();
    const std::string page = make_page(whole / 2);
    EXPECT_LT(page.size(), whole / 2 + 6000) << "the descriptions of layers and maps come on top";
    const Json data = data_of(page);
    EXPECT_GT(data["layers_left_out"], 0);
    EXPECT_TRUE(data["pictures"][0].contains("reference"));
    EXPECT_TRUE(data["variants"][1]["frames"][0].contains("picture")) << "of the variant on the front";
    EXPECT_FALSE(data["variants"][0]["frames"][0]["maps"].contains("error.edges"));
}

TEST_F(ReportPage, SeveralScenesHaveNamedFrames) {
    results.frames.push_back(results.frames[0]);
    results.frames[1].scene = "other";
    const Json data = data_of(make_page());
    EXPECT_EQ(data["frames"], Json::array({"noise 7", "other 7"}));
    EXPECT_FALSE(data.contains("scene")) << "the frames name theirs";
    EXPECT_EQ(data["variants"][0]["frames"][0]["frame"], "noise 7");
}

TEST_F(ReportPage, OtherJudgesHaveMapsOfTheSameNames) {
    const ScratchFolder judged;
    results.judges = {{"other", judged.path()}};
    EXPECT_THROW(make_page(), InputError) << "no map at all";
    write_exr(judged / "picture.exr", {{{"Y", Image<float>(31, 32, 2.0f)}}, {}});
    EXPECT_THROW(make_page(), InputError) << "another size";
    write_exr(judged / "picture.exr", {{{"Y", Image<float>(32, 32, 2.0f)}}, {}});
    const Json data = data_of(make_page());
    EXPECT_EQ(data["judges"][0]["map"], "judge.other");
    EXPECT_TRUE(data["variants"][0]["frames"][0]["maps"].contains("judge.other"));
    results.judges[0].frames = {{7, judged / "picture.exr"}};
    EXPECT_THROW(make_page(), InputError) << "which variant is it of?";
    results.variants.pop_back();
    const Json one = data_of(make_page());
    EXPECT_TRUE(one["variants"][0]["frames"][0]["maps"].contains("judge.other"));
}

TEST_F(ReportPage, EveryMapOfTheWalkIsDescribedOnce) {
    std::set<std::string> names;
    for (const Json& map : report_maps()) EXPECT_TRUE(names.insert(map["name"]).second) << map["name"];
    for (const Json& step : report_walk({})) {
        if (!step.contains("channels")) continue;
        for (const Json& channel : step["channels"])
            EXPECT_TRUE(names.contains(channel["name"])) << channel["name"] << " has no scale";
    }
}

TEST(ViewerPage, HoldsSequencesWithTheirLevels) {
    const ScratchFolder folder;
    Study study;
    study.title = "</script>";
    study.scenes = {{source_folder() / "scenes/cornell/scene.json", "3-4"}};
    study.settings = {{"size", std::string("16x12")}, {"filter", std::string("box")}};
    study.reference = {"gather", 2, 1, {}};
    study.settings["viewing.display_white"] = 250.0;
    study.sweep = {{"guide", {std::string("none")}}, {"spp", {1.0, 2.0}}};
    study.variants = {{"clean", {{"noise", 0.0}}}, {"noisy", {{"zero_mean_noise", 2.0}}}};
    study.viewers = {{"own", {}}};
    const PreparedStudy prepared = prepare_study(study);
    const StudyResults results = run_study(prepared, folder.path());
    const std::string page = make_viewer_test("<!-- TEST DATA -->", prepared, results, {});
    const std::string start = "<script id=\"test\" type=\"application/json\">";
    ASSERT_TRUE(page.starts_with(start));
    const auto json = nlohmann::json::parse(page.substr(start.size(), page.find("</script>") - start.size()));
    expect_fields(json, R"({"title": "</script>", "width": 16})");
    ASSERT_EQ(json["series"].size(), 3u);
    EXPECT_EQ(json["series"][0]["id"], "noise");
    EXPECT_EQ(json["series"][2]["title"], "spp") << "the first sweep with numbers";
    ASSERT_EQ(json["scenes"].size(), 1u);
    const auto& scene = json["scenes"][0];
    expect_fields(scene, R"({"frames_per_second": 30, "display_white": 250})");
    EXPECT_EQ(scene["reference"].size(), 2u);
    const auto& tests = scene["tests"];
    ASSERT_EQ(tests.size(), 4u);
    expect_fields(tests[1], R"({"series": "spp", "level": 2})");
    EXPECT_EQ(tests[1]["frames"].size(), 2u);
    const std::string link = tests[0]["frames"][0];
    EXPECT_TRUE(link.starts_with("data:image/png;base64,iVBOR")) << link.substr(0, 40);
    EXPECT_NE(tests[0]["frames"][0], tests[1]["frames"][0]);
    EXPECT_EQ(tests[2]["series"], "noise");
    EXPECT_EQ(tests[2]["frames"][0], scene["reference"][0]) << "no noise";
    EXPECT_EQ(tests[3]["series"], "zero_mean_noise");
    EXPECT_NE(tests[3]["frames"][0], scene["reference"][0]);
}

}  // namespace
}  // namespace aleph
