// Archives whose container is sound and whose samples, times, surfaces or transforms are not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/engine/alembic/verdict.h"

namespace aleph {
namespace {

TEST(AlembicBadFile, SampleCountsBeyondWhatIsStored) {
    DraftObject mesh = draft_mesh("m", {triangle, triangle}, {{3}}, {{0, 1, 2}});
    mesh.properties[0].children[0].claimed_samples = 0xffffffff;
    expect_refused(verdict({mesh}), "holds 4");
    mesh.properties[0].children[0].claimed_samples = 3;
    expect_refused(verdict({mesh}), "missing");
    mesh.properties[0].children[0].claimed_samples = 0;
    EXPECT_EQ(verdict({mesh}), "");
}

TEST(AlembicBadFile, MoreSamplesThanTimes) {
    expect_refused(verdict({draft_mesh("m", std::vector(5, triangle), {{3}}, {{0, 1, 2}})}), "only 4 times");
}

TEST(AlembicBadFile, TimesThatDoNotIncrease) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& times :
         {std::vector{0.0, 0.0}, std::vector{1.0, 0.5}, std::vector{0.0, nan}, std::vector{0.0, inf}}) {
        OgawaDraft draft;
        draft.times = times;
        expect_refused(verdict(draft.finish(std::vector<DraftObject>{})), "times must be finite and increase");
    }
    for (const double period : {0.0, -1.0, nan}) {
        OgawaDraft draft;
        draft.period = period;
        expect_refused(verdict(draft.finish(std::vector<DraftObject>{})), "must be positive");
    }
}

TEST(AlembicBadFile, TopologyThatDoesNotFit) {
    const auto mesh = [](const std::vector<int>& counts, const std::vector<int>& indices) {
        return verdict({draft_mesh("m", {triangle}, {counts}, {indices})});
    };
    expect_refused(mesh({3}, {0, 1, 3}), "point 3");
    expect_refused(mesh({3}, {0, 1, -1}), "point -1");
    expect_refused(mesh({4}, {0, 1, 2}), "claims 4 points");
    expect_refused(mesh({-1, 4}, {0, 1, 2}), "claims -1 points");
    expect_refused(mesh({0x7fffffff}, {0, 1, 2}), "points, 3 are left");
    expect_refused(mesh({2}, {0, 1, 2}), "3 are given");
    EXPECT_EQ(mesh({}, {}), "");
    EXPECT_EQ(mesh({0, 1, 2}, {0, 1, 2}), "");
    EXPECT_EQ(verdict({draft_mesh("m", {{}}, {{}}, {{}})}), "");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_refused(verdict({draft_mesh("m", {{0, 0, 0, 1, 0, 0, 0, nan, 0}}, {{3}}, {{0, 1, 2}})}), "not finite");
}

TEST(AlembicBadFile, CagesThatCannotBeSubdivided) {
    const auto crease = [](const std::vector<int>& points, const std::vector<int>& lengths) {
        return verdict({draft_subd("s", {triangle}, {{3}}, {{0, 1, 2}},
                                   {draft_array<int>(".creaseIndices", DraftProperty::i32, 1, {points}),
                                    draft_array<int>(".creaseLengths", DraftProperty::i32, 1, {lengths}),
                                    draft_array<float>(".creaseSharpnesses", DraftProperty::f32, 1, {{2.0f}})})});
    };
    EXPECT_EQ(crease({0, 1}, {2}), "");  // though its boundary rule, the default, would draw nothing
    EXPECT_NE(crease({0, 7}, {2}), "");
    EXPECT_NE(crease({0, 1}, {5}), "");
    EXPECT_NE(verdict({draft_subd("s", {triangle}, {{4}}, {{0, 1, 0, 1}})}), "");
}

/// A cage whose faces share one block with others: what refinement takes counts too.
TEST(AlembicBadFile, LargeCages) {
    const int side = 260;
    std::vector<float> points;
    std::vector<int> counts(static_cast<std::size_t>(side) * side, 4), indices;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x)
            for (const int c : {x, y, 0}) points.push_back(static_cast<float>(c));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const int i :
                 {y * (side + 1) + x, y * (side + 1) + x + 1, (y + 1) * (side + 1) + x + 1, (y + 1) * (side + 1) + x})
                indices.push_back(i);
    verdict({draft_subd("s", {points}, {counts}, {indices})});
}

TEST(AlembicBadFile, WarningsAreFew) {
    std::vector<DraftObject> objects;
    for (std::size_t i = 0; i < 300; ++i) {
        const std::vector<float> values(2 * (i + 4));
        objects.push_back(draft_mesh(fmt::format("m{}", i), {triangle}, {{3}}, {{0, 1, 2}},
                                     {draft_array<float>("uv", DraftProperty::f32, 2, {values}, "geoScope=fvr")}));
    }
    const ScratchFolder folder;
    OgawaDraft draft;
    const Scene scene = load_scene(write_draft(folder / "many.abc", draft.finish(objects)));
    EXPECT_LT(scene.warnings.size(), 110u);
    EXPECT_NE(scene.warnings[100].find("and 200 more warnings"), std::string::npos) << scene.warnings[100];
}

TEST(AlembicBadFile, TransformsThatDoNotFit) {
    const auto xform = [](const std::vector<std::uint8_t>& operations, const std::vector<double>& channels) {
        const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(std::max<std::size_t>(n, 1)); };
        DraftProperty ops{".ops",
                          DraftProperty::scalar,
                          DraftProperty::u8,
                          count(operations.size()),
                          {bytes_of(operations)},
                          0,
                          "",
                          {},
                          -1};
        DraftProperty vals{
            ".vals", DraftProperty::scalar, DraftProperty::f64, count(channels.size()), {bytes_of(channels)}, 0, "", {},
            -1};
        return verdict({DraftObject{"x", "schema=AbcGeom_Xform_v3", {draft_compound(".xform", {ops, vals})}, {}}});
    };
    EXPECT_EQ(xform({0x10}, {1, 2, 3}), "");
    expect_refused(xform({0x10}, {1, 2}), "2 channels, its operations take 3");
    expect_refused(xform({0x70}, {1, 2}), "unknown type 7");
    expect_refused(xform({0x10}, {1, 2, std::numeric_limits<double>::infinity()}), "inf");
    expect_refused(xform({0x30}, std::vector<double>(16, 1.0)), "not affine");
}
}  // namespace
}  // namespace aleph
