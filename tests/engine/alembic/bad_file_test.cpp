// Damaged and hostile archives end in an InputError or a scene, within limits of time and memory.
#include "tests/engine/alembic/verdict.h"
#include "tests/support/files/alembic_truth.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

TEST(AlembicBadFile, MalformedArchivesOfTheReferenceLibrary) {
    const std::filesystem::path folder = assets_folder() / "abc/malformed";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << missing_asset(folder);
    int files = 0, refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".abc") continue;
        ++files;
        refused += !verdict(entry.path()).empty();
    }
    EXPECT_EQ(files, 12);
    EXPECT_EQ(refused, 10);  // two are harmless: bad text, and a property that the reader does not use
}

TEST(AlembicBadFile, WhatIsNoFinishedOgawaArchive) {
    expect_refused(verdict(DraftBytes{}), "not an Alembic archive");
    expect_refused(verdict(bytes_of(std::vector<char>{'v', ' ', '0'})), "not an Alembic archive");
    expect_refused(verdict(DraftBytes{0x89, 'H', 'D', 'F', '\r', '\n'}), "abcconvert");
    DraftBytes bytes = OgawaDraft().finish(std::vector<DraftObject>{});
    EXPECT_EQ(verdict(bytes), "");
    bytes[5] = 0;
    expect_refused(verdict(bytes), "never finished");
    bytes[5] = 0xff, bytes[7] = 2;
    expect_refused(verdict(bytes), "version 2");
    bytes[7] = 1, bytes[15] = 0xff;
    EXPECT_NE(verdict(bytes), "");
}

/// Cut at 60 places: parents and tables stand last, so that a cut file has lost its root.
TEST(AlembicBadFile, TruncatedEverywhere) {
    const ScratchFolder folder;
    for (const std::string& name : own_archives) {
        const DraftBytes whole = read_numbers(archive_path(name));
        for (std::size_t i = 0; i < 60; ++i) {
            const DraftBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() * i / 60));
            EXPECT_NE(verdict(write_draft(folder / "cut.abc", cut)), "") << name << " cut to " << cut.size();
        }
    }
}

/// One byte changed, at places spread over the whole file.
TEST(AlembicBadFile, OneByteDamaged) {
    const ScratchFolder folder;
    int refused = 0, loaded = 0;
    for (const std::string& name : own_archives) {
        const DraftBytes whole = read_numbers(archive_path(name));
        for (std::size_t i = 0; i < 250; ++i) {
            DraftBytes damaged = whole;
            const std::size_t at = (i * 2654435761u + 97 * i) % whole.size();
            damaged[at] = static_cast<std::uint8_t>(i % 3 == 0 ? 0xff : i % 3 == 1 ? damaged[at] ^ (1u << i % 8) : 0);
            (verdict(write_draft(folder / "damaged.abc", damaged)).empty() ? loaded : refused) += 1;
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(loaded, 100);
}

TEST(AlembicBadFile, CountsAndOffsetsBeyondTheFile) {
    const std::uint64_t big = 0x7fffffffffffffff;
    const auto with_root = [&](const std::function<std::uint64_t(OgawaDraft&)>& make) {
        OgawaDraft draft;
        const std::uint64_t root = make(draft);
        return verdict(draft.finish(root));
    };
    expect_refused(with_root([&](OgawaDraft&) { return big; }), "outside the file");
    expect_refused(with_root([&](OgawaDraft&) { return big - 7; }), "outside the file");
    for (const std::uint64_t size : {big, std::uint64_t{1} << 61, (std::uint64_t{1} << 61) - 1, std::uint64_t{1} << 32})
        expect_refused(with_root([&](OgawaDraft& d) {
                           const std::uint64_t offset = d.bytes.size();
                           OgawaDraft::put(d.bytes, size, 8);
                           return offset;
                       }),
                       "children, the file has room");
    for (const std::uint64_t size : {big, ~std::uint64_t{0}, ~std::uint64_t{7}, std::uint64_t{1} << 40})
        expect_refused(with_root([&](OgawaDraft& d) {
                           const std::uint64_t offset = d.bytes.size();
                           OgawaDraft::put(d.bytes, size, 8);
                           return d.add_group({0, offset | OgawaDraft::data_bit});
                       }),
                       "bytes, the file has");
}

TEST(AlembicBadFile, ObjectsThatContainThemselves) {
    OgawaDraft draft;
    const std::uint64_t headers = draft.add_data(OgawaDraft::child_headers({{"a", ""}, {"b", ""}}));
    const std::uint64_t self = draft.bytes.size();
    draft.add_group({0, self, self, headers});
    expect_refused(verdict(draft.finish(self)), "contains itself");
}

TEST(AlembicBadFile, DeepNesting) {
    for (const int depth : {1000, 1100, 100000}) {
        OgawaDraft draft;
        const std::uint64_t headers = draft.add_data(OgawaDraft::child_headers({{"a", ""}}));
        std::uint64_t group = 0;
        for (int i = 0; i < depth; ++i) group = draft.add_group({0, group, headers});
        const std::string message = verdict(draft.finish(group));
        if (depth > 1024) {
            expect_refused(message, "nested deeper than 1024");
        } else {
            EXPECT_EQ(message, "");
        }
    }
}

/// Groups that share their children: 2^40 objects in a few hundred bytes.
TEST(AlembicBadFile, SharedGroupsMultiply) {
    OgawaDraft draft;
    const std::uint64_t headers = draft.add_data(OgawaDraft::child_headers({{"a", ""}, {"b", ""}}));
    std::uint64_t group = 0;
    for (int i = 0; i < 40; ++i) group = draft.add_group({0, group, group, headers});
    EXPECT_NE(verdict(draft.finish(group)), "");
}

TEST(AlembicBadFile, InstancesOfThemselvesAndOfWhatIsMissing) {
    expect_refused(verdict({draft_instance("a", "/a")}), "instance of itself");
    expect_refused(verdict({draft_instance("a", "/b"), draft_instance("b", "/a")}), "/a");
    expect_refused(verdict({draft_instance("a", "/nowhere")}), "not there");
    expect_refused(verdict({draft_instance("a", "")}), "not there");
    expect_refused(verdict({draft_group("a", {draft_instance("b", "/a")})}), "contains itself");
    expect_refused(
        verdict({draft_group("a", {draft_instance("b", "/c")}), draft_group("c", {draft_instance("d", "/a")})}),
        "contains itself");
    expect_refused(verdict({draft_instance("a", "/a/b/c/d/e")}), "not there");
}

/// Each level holds the one below twice: 2^30 boxes.
TEST(AlembicBadFile, InstancesMultiply) {
    std::vector<DraftObject> levels{draft_triangle("l0")};
    for (int i = 1; i <= 30; ++i) {
        const std::string below = fmt::format("/l{}", i - 1);
        levels.push_back(draft_group(fmt::format("l{}", i), {draft_instance("x", below), draft_instance("y", below)}));
    }
    EXPECT_NE(verdict(levels), "");
}

/// One large array, reached by many samples and objects.
TEST(AlembicBadFile, SharedDataMultiplies) {
    OgawaDraft draft;
    DraftBytes payload(16);
    const DraftBytes values = bytes_of(std::vector<float>(300000, 1.0f));
    payload.insert(payload.end(), values.begin(), values.end());
    const std::uint64_t block = draft.add_data(payload);
    std::vector<std::uint64_t> samples;
    for (int i = 0; i < 3000; ++i) samples.insert(samples.end(), {block, OgawaDraft::data_bit});
    DraftObject mesh = draft_triangle("m");
    DraftProperty& points = mesh.properties[0].children[0];
    points.group = draft.add_group(samples);
    points.claimed_samples = 3000;
    points.sampling = 1;
    expect_refused(verdict(draft.finish({mesh})), "MiB of memory");
}

}  // namespace
}  // namespace aleph
