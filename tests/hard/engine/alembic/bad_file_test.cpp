// Damaged and hostile archives end in an InputError or a scene, soon and within bounds (HARD_CASES: hostile input).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <ctime>
#include <filesystem>
#include <functional>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "tests/support/alembic_draft.h"
#include "tests/support/alembic_truth.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
constexpr double most_seconds = 2.0;
#else
constexpr double most_seconds = 60.0;
#endif

#ifndef __SANITIZE_ADDRESS__
long peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}
#endif

/// Loads and poses; the message of a refusal, or empty. Anything but an InputError fails the test by leaving it.
std::string verdict(const std::filesystem::path& path) {
    const std::clock_t start = std::clock();  // of this process: others may keep the machine busy
    std::string message;
    try {
        const Scene scene = load_scene(path);
        pose(scene, 0.05);
    } catch (const InputError& error) {
        EXPECT_EQ(error.file(), path.string());
        EXPECT_LT(std::string(error.what()).size(), 1000u);
        message = error.what();
        EXPECT_FALSE(message.empty());
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, most_seconds) << path << ": " << message;
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(peak_megabytes(), 512) << path << ": " << message;
#endif
    return message;
}

std::string verdict(const DraftBytes& bytes) {
    const ScratchFolder folder;
    return verdict(write_draft(folder / "bad.abc", bytes));
}

std::string verdict(const std::vector<DraftObject>& objects) {
    OgawaDraft draft;
    draft.times = {0.0, 1.0, 2.0, 3.0};
    return verdict(draft.finish(objects));
}

void expect_refused(const std::string& message, const std::string& word) {
    EXPECT_NE(message.find(word), std::string::npos) << "expected \"" << word << "\" in \"" << message << "\"";
}

const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(AlembicBadFile, MalformedArchivesOfTheReferenceLibrary) {
    const std::filesystem::path folder = assets_folder() / "abc/malformed";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "not here: " << folder;
    int files = 0, refused = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".abc") continue;
        ++files;
        refused += !verdict(entry.path()).empty();
    }
    EXPECT_EQ(files, 12);
    EXPECT_EQ(refused, 10);  // two are harmless: bad text, and a property that nobody asks for
}

TEST(AlembicBadFile, WhatIsNoFinishedOgawaArchive) {
    expect_refused(verdict(DraftBytes{}), "no Alembic archive");
    expect_refused(verdict(bytes_of(std::vector<char>{'v', ' ', '0'})), "no Alembic archive");
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
        const DraftBytes whole = file_bytes(archive_path(name));
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
        const DraftBytes whole = file_bytes(archive_path(name));
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
    std::vector<DraftObject> levels{draft_mesh("l0", {triangle}, {{3}}, {{0, 1, 2}})};
    for (int i = 1; i <= 30; ++i) {
        const std::string below = fmt::format("/l{}", i - 1);
        levels.push_back(draft_group(fmt::format("l{}", i), {draft_instance("x", below), draft_instance("y", below)}));
    }
    EXPECT_NE(verdict(levels), "");
}

/// One large array, reached by many samples and objects.
TEST(AlembicBadFile, SharedDataMultiplies) {
    OgawaDraft draft;
    std::vector<float> many(300000, 1.0f);
    DraftBytes payload(16);
    const DraftBytes values = bytes_of(many);
    payload.insert(payload.end(), values.begin(), values.end());
    const std::uint64_t block = draft.add_data(payload);
    std::vector<std::uint64_t> samples;
    for (int i = 0; i < 3000; ++i) samples.insert(samples.end(), {block, OgawaDraft::data_bit});
    const std::uint64_t points = draft.add_group(samples);
    // The mesh as the draft writes it, its points' group put in place of an empty one.
    DraftObject mesh = draft_mesh("m", {{}}, {{3}}, {{0, 1, 2}});
    DraftProperty& p = mesh.properties[0].children[0];
    p.samples.clear();
    p.claimed_samples = 3000;
    p.sampling = 1;
    DraftBytes bytes = draft.finish({mesh});
    // The compound's group: find the header's group by its zero child word, the only one of .geom.
    bool replaced = false;
    for (std::size_t at = bytes.size() - 8; at > payload.size() + 16 && !replaced; --at) {
        std::uint64_t count = 0, first = 1;
        std::memcpy(&count, bytes.data() + at, 8);
        if (count != 4 || at + 16 > bytes.size()) continue;
        std::memcpy(&first, bytes.data() + at + 8, 8);
        if (first != 0) continue;
        std::memcpy(bytes.data() + at + 8, &points, 8);
        replaced = true;
    }
    ASSERT_TRUE(replaced);
    expect_refused(verdict(bytes), "MiB of memory");
}

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
