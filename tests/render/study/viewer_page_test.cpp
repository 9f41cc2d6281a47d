// The data of the viewer test.

#include "render/study/viewer_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

TEST(ViewerPage, HoldsSequencesWithTheirLevels) {
    const ScratchFolder folder;
    Study study;
    study.title = "</script>";
    study.scenes = {{source_folder() / "scenes/cornell/scene.json", "3-4"}};
    study.settings = {{"size", std::string("16x12")}, {"filter", std::string("box")}};
    study.reference = {"gather", 2, 1, {}};
    study.sweep = {{"guide", {std::string("none")}}, {"spp", {1.0, 2.0}}};
    study.viewers = {{"own", {}}};
    const PreparedStudy prepared = prepare_study(study);
    const StudyResults results = run_study(prepared, folder.path());
    const std::string page = make_viewer_test("<!-- TEST DATA -->", prepared, results, {});
    const std::string start = "<script id=\"test\" type=\"application/json\">";
    ASSERT_TRUE(page.starts_with(start));
    const auto json = nlohmann::json::parse(page.substr(start.size(), page.find("</script>") - start.size()));
    EXPECT_EQ(json["title"], "</script>");
    EXPECT_EQ(json["width"], 16);
    EXPECT_EQ(json["frames_per_second"], 30.0);
    EXPECT_EQ(json["level"]["title"], "spp") << "the first sweep with numbers";
    EXPECT_EQ(json["reference"]["frames"].size(), 2u);
    ASSERT_EQ(json["tests"].size(), 2u);
    EXPECT_EQ(json["tests"][1]["level"], 2.0);
    EXPECT_EQ(json["tests"][1]["frames"].size(), 2u);
    const std::string link = json["tests"][0]["frames"][0];
    EXPECT_TRUE(link.starts_with("data:image/png;base64,iVBOR")) << link.substr(0, 40);
    EXPECT_NE(json["tests"][0]["frames"][0], json["tests"][1]["frames"][0]);
}

}  // namespace
}  // namespace aleph
