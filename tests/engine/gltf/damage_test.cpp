// glTF files with random damage, and with numbers replaced by others.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

class GltfDamage : public testing::Test {
  protected:
    ScratchFolder folder_;
};

/// Every way to cut the file, and thousands of random damages: an answer each time, never a crash. The same twice.
TEST_F(GltfDamage, S13_10_DamagedFilesLoadOrAreRefused) {
    const Bytes good = textured_draft(folder_, false).to_glb();
    const fs::path path = folder_ / "damaged.glb";
    const auto verdict = [&](const Bytes& bytes) {
        write_bytes(path, bytes);
        Scene scene;
        const Refusal found = find_refusal([&] { append_gltf(path, scene, no_index, 0); });
        if (!found.message.empty()) {
            EXPECT_EQ(found.file, path.string());
        }
        return found.message;
    };
    ASSERT_EQ(verdict(good), "");
    for (std::size_t length = 0; length < good.size(); length += 7) {
        Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_NE(verdict(cut), "") << length;
    }
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes = good;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int k = 0; k < changes; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        const std::string first = verdict(bytes);
        if (!first.empty()) ++refused;
        if (i % 50 == 0) {
            EXPECT_EQ(verdict(bytes), first);
        }
    }
    EXPECT_GT(refused, 500);
}

/// Digits of the JSON replaced by others: well-formed files whose numbers lie.
TEST_F(GltfDamage, S12_9_LyingNumbersLoadOrAreRefused) {
    GltfDraft base = textured_draft(folder_, false);
    base.set_length();
    const std::vector<Json> lies = {
        -1,           0,     1,   2,   3,       7,    255,           65536,         2147483647,
        4294967296ll, 1e300, 0.5, "1", nullptr, true, Json::array(), Json::object()};
    const Json flat = base.json.flatten();
    int tried = 0, refused = 0;
    for (const auto& [pointer, value] : flat.items()) {
        for (const Json& lie : lies) {
            GltfDraft draft = base;
            draft.json[Json::json_pointer(pointer)] = lie;
            write_text(folder_ / "lie.gltf", draft.to_text());
            Scene scene;
            ++tried;
            const Refusal found = find_refusal([&] { append_gltf(folder_ / "lie.gltf", scene, no_index, 0); });
            if (found.message.empty()) continue;
            EXPECT_EQ(found.file, (folder_ / "lie.gltf").string());
            ++refused;
        }
    }
    EXPECT_GT(tried, 1500);
    EXPECT_GT(refused, tried / 2);
}
}  // namespace
}  // namespace aleph
