// Archives whose root, headers and texts are damaged, byte by byte; and sound ones whose samples, times, surfaces or
// transforms are not.

#include "tests/engine/alembic/verdict.h"

namespace aleph {
namespace {

TEST(AlembicBadFile, SampleCountsBeyondWhatIsStored) {
    DraftObject mesh = draft_mesh("m", {draft_points, draft_points}, {{3}}, {{0, 1, 2}});
    mesh.properties[0].children[0].claimed_samples = 0xffffffff;
    expect_refused(verdict({mesh}), "holds 4");
    mesh.properties[0].children[0].claimed_samples = 3;
    expect_refused(verdict({mesh}), "missing");
    mesh.properties[0].children[0].claimed_samples = 0;
    EXPECT_EQ(verdict({mesh}), "");
}

TEST(AlembicBadFile, MoreSamplesThanTimes) {
    expect_refused(verdict({draft_mesh("m", std::vector(5, draft_points), {{3}}, {{0, 1, 2}})}), "only 4 times");
}

TEST(AlembicBadFile, TimesThatDoNotIncrease) {
    for (const std::vector<double>& times :
         {std::vector{0.0, 0.0}, std::vector{1.0, 0.5}, std::vector{0.0, not_a_number}, std::vector{0.0, infinity}}) {
        OgawaDraft draft;
        draft.times = times;
        expect_refused(verdict(draft.finish(std::vector<DraftObject>{})), "times must be finite and increase");
    }
    for (const double period : {0.0, -1.0, not_a_number}) {
        OgawaDraft draft;
        draft.period = period;
        expect_refused(verdict(draft.finish(std::vector<DraftObject>{})), "must be positive");
    }
}

TEST(AlembicBadFile, TopologyThatDoesNotFit) {
    const auto mesh = [](const std::vector<int>& counts, const std::vector<int>& indices) {
        return verdict({draft_mesh("m", {draft_points}, {counts}, {indices})});
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
    expect_refused(verdict({draft_mesh("m", {{0, 0, 0, 1, 0, 0, 0, float_nan, 0}}, {{3}}, {{0, 1, 2}})}), "not finite");
}

TEST(AlembicBadFile, CagesThatCannotBeSubdivided) {
    const auto crease = [](const std::vector<int>& points, const std::vector<int>& lengths) {
        return verdict({draft_subd("s", {draft_points}, {{3}}, {{0, 1, 2}},
                                   {draft_array<int>(".creaseIndices", DraftProperty::i32, 1, {points}),
                                    draft_array<int>(".creaseLengths", DraftProperty::i32, 1, {lengths}),
                                    draft_array<float>(".creaseSharpnesses", DraftProperty::f32, 1, {{2.0f}})})});
    };
    EXPECT_EQ(crease({0, 1}, {2}), "");  // though its boundary rule, the default, would draw nothing
    EXPECT_NE(crease({0, 7}, {2}), "");
    EXPECT_NE(crease({0, 1}, {5}), "");
    EXPECT_NE(verdict({draft_subd("s", {draft_points}, {{4}}, {{0, 1, 0, 1}})}), "");
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
        objects.push_back(draft_triangle(fmt::format("m{}", i),
                                         {draft_array<float>("uv", DraftProperty::f32, 2, {values}, "geoScope=fvr")}));
    }
    const ScratchFolder folder;
    OgawaDraft draft;
    const Scene scene = load_scene(write_draft(folder / "many.abc", draft.finish(objects)));
    EXPECT_LT(scene.source.warnings.size(), 110u);
    EXPECT_NE(scene.source.warnings[100].find("and 200 more warnings"), std::string::npos)
        << scene.source.warnings[100];
}

TEST(AlembicBadFile, TransformsThatDoNotFit) {
    const auto xform = [](const std::vector<std::uint8_t>& operations, const std::vector<double>& channels) {
        const auto ops = draft_scalar<std::uint8_t>(".ops", DraftProperty::u8, {operations});
        const auto vals = draft_scalar<double>(".vals", DraftProperty::f64, {channels});
        return verdict({DraftObject{"x", "schema=AbcGeom_Xform_v3", {draft_compound(".xform", {ops, vals})}, {}}});
    };
    EXPECT_EQ(xform({0x10}, {1, 2, 3}), "");
    expect_refused(xform({0x10}, {1, 2}), "2 channels, its operations take 3");
    expect_refused(xform({0x70}, {1, 2}), "unknown type 7");
    expect_refused(xform({0x10}, {1, 2, infinity}), "inf");
    expect_refused(xform({0x30}, std::vector<double>(16, 1.0)), "not affine");
}

/// Words of a property's header, as the format packs them.
struct Header {
    std::uint64_t kind = DraftProperty::scalar, hint = 2, type = DraftProperty::f32, flags = 0x100, extent = 1,
                  metadata = 0;
    std::vector<std::uint64_t> numbers{1, 0};  ///< samples, then the changed ones if flags has 0x200, then the sampling
    std::string name = "p";
    std::uint64_t name_length = 1;

    DraftBytes bytes() const {
        DraftBytes result;
        OgawaDraft::put(result, kind | hint << 2 | type << 4 | flags | extent << 12 | metadata << 20, 4);
        const int width = 1 << hint;
        for (const std::uint64_t number : numbers) OgawaDraft::put(result, number, width);
        OgawaDraft::put(result, name_length, width);
        result.insert(result.end(), name.begin(), name.end());
        return result;
    }
};

/// A transform whose property group has these headers, and one child for them.
std::string verdict_of_headers(const DraftBytes& headers, std::uint64_t child = 0) {
    OgawaDraft draft;
    const std::uint64_t properties = draft.add_group({child, draft.add_data(headers)});
    const std::uint64_t object = draft.add_group({properties, draft.add_data(OgawaDraft::child_headers({}))});
    const std::uint64_t names = draft.add_data(OgawaDraft::child_headers({{"x", "schema=AbcGeom_Xform_v3"}}));
    return verdict(draft.finish(draft.add_group({0, object, names})));
}

TEST(AlembicBadHeader, OfProperties) {
    EXPECT_EQ(verdict_of_headers(Header{}.bytes()), "");
    expect_refused(verdict_of_headers(Header{.metadata = 96}.bytes()), "metadata number 96 is beyond the table's 0");
    expect_refused(verdict_of_headers(Header{.hint = 3}.bytes()), "size hint 3");
    expect_refused(verdict_of_headers(Header{.type = 14}.bytes()), "unknown type 14");
    expect_refused(verdict_of_headers(Header{.extent = 0}.bytes()), "extent 0");
    expect_refused(verdict_of_headers(Header{.numbers = {1, 9}}.bytes()), "time sampling 9 is asked for, there are 2");
    expect_refused(verdict_of_headers(Header{.name = "", .name_length = 0}.bytes()), "no name");
    expect_refused(verdict_of_headers(Header{.name_length = 2}.bytes()), "2 bytes claimed, 1 left");
    expect_refused(verdict_of_headers(Header{.name_length = 0xffffffff}.bytes()), "4294967295 bytes claimed");
    DraftBytes cut = Header{}.bytes();
    cut.resize(3);
    expect_refused(verdict_of_headers(cut), "ends inside a record");
}

TEST(AlembicBadHeader, RangesOfChangedSamples) {
    const auto changed = [](std::uint64_t first, std::uint64_t last) {
        return verdict_of_headers(Header{.flags = 0x300, .numbers = {5, first, last, 0}}.bytes());
    };
    EXPECT_EQ(changed(1, 4), "");
    EXPECT_EQ(changed(0, 0), "");
    expect_refused(changed(3, 2), "samples 3 to 2 of 5");
    expect_refused(changed(0, 2), "samples 0 to 2 of 5");
    expect_refused(changed(1, 5), "samples 1 to 5 of 5");
}

TEST(AlembicBadHeader, OfObjects) {
    const auto children = [](const DraftBytes& headers) {
        OgawaDraft draft;
        const std::uint64_t names = draft.add_data(headers);
        return verdict(draft.finish(draft.add_group({0, 0, names})));
    };
    EXPECT_EQ(children(OgawaDraft::child_headers({{"x", ""}})), "");
    expect_refused(children(OgawaDraft::child_headers({{"", ""}})), "no name");
    expect_refused(children(OgawaDraft::child_headers({{"x", ""}, {"y", ""}})), "a data block stands where");
    DraftBytes beyond = OgawaDraft::child_headers({{"x", ""}});
    beyond[5] = 7;  // in place of 255, metadata that follows
    expect_refused(children(beyond), "metadata number 7 is beyond the table's 0");
    DraftBytes longer = OgawaDraft::child_headers({{"x", ""}});
    longer[0] = 200;
    expect_refused(children(longer), "200 bytes claimed");
}

TEST(AlembicBadHeader, OfTheRoot) {
    const auto root = [](const std::function<std::uint64_t(OgawaDraft&)>& make) {
        OgawaDraft draft;
        draft.finish(std::vector<DraftObject>{});
        const std::uint64_t top = make(draft);
        for (int i = 0; i < 8; ++i) draft.bytes[8 + i] = static_cast<std::uint8_t>(top >> 8 * i);
        return verdict(draft.bytes);
    };
    expect_refused(root([](OgawaDraft& d) { return d.add_group({}); }), "the root has 0 children");
    expect_refused(root([](OgawaDraft& d) { return d.add_group({0, 0, 0, 0, 0}); }), "the root has 5 children");
    const auto version = [&](std::uint8_t number) {
        return root([number](OgawaDraft& d) {
            const std::uint64_t layout = d.add_data({number, 0, 0, 0}), library = d.add_data({1, 0, 0, 0});
            return d.add_group({layout, library, 0, OgawaDraft::data_bit, OgawaDraft::data_bit, OgawaDraft::data_bit});
        });
    };
    EXPECT_EQ(version(0), "");
    expect_refused(version(3), "version 3 is not supported");
    expect_refused(root([](OgawaDraft& d) {
                       return d.add_group({0, 0, 0, 0, 0, 0});
                   }),
                   "a group stands where a data block is expected");
    expect_refused(root([](OgawaDraft& d) {
                       const std::uint64_t four = d.add_data({0, 0, 0, 0});
                       return d.add_group({four, four, four, OgawaDraft::data_bit, OgawaDraft::data_bit, four});
                   }),
                   "a data block stands where a group is expected");
}

TEST(AlembicBadHeader, CyclesLongerThanTheirPeriod) {
    OgawaDraft draft;
    draft.cyclic = true;
    draft.times = {0.0, 2.0};
    draft.period = 1.0;
    expect_refused(verdict(draft.finish(std::vector<DraftObject>{})), "span more than the cycle");
}

/// A child of the wrong kind does no harm where nothing reads it.
TEST(AlembicBadHeader, ChildrenOfTheWrongKind) {
    const std::uint64_t nothing = OgawaDraft::data_bit;
    expect_refused(verdict_of_headers(Header{}.bytes(), nothing), "a data block stands where a group is expected");
    OgawaDraft draft;
    const std::uint64_t unread = draft.add_data({1, 2, 3});
    EXPECT_EQ(verdict(draft.finish(draft.add_group({0, unread}))), "");
}

TEST(AlembicBadHeader, TextsThatDoNotEnd) {
    DraftObject instance = draft_instance("i", "/a");
    instance.properties[0].samples = {{'/', 'a'}};
    expect_refused(verdict({draft_group("a", {}), instance}), "a text does not end");
    instance.properties[0].extent = 200;
    expect_refused(verdict({draft_group("a", {}), instance}), "claims 200 texts in 2 bytes");
    DraftObject unread = draft_group("a", {});
    unread.properties = {draft_text("comment", "")};
    unread.properties[0].samples = {{'b', 'a', 'd'}};
    EXPECT_EQ(verdict({unread}), "");
}

}  // namespace
}  // namespace aleph
