// Archives whose root, headers of objects and properties, or texts are damaged: written by hand, byte by byte.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/engine/alembic/verdict.h"

namespace aleph {
namespace {

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
