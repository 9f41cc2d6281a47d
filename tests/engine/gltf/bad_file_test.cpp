// Broken and hostile glTF files below the JSON: containers, text, key values, URIs, multiplication.
#include <sys/stat.h>

#include "tests/support/files/gltf_bad_input.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

class GltfBadFile : public testing::Test {
  protected:
    void expect_text_refused(const std::string& text, const std::string& place, const std::string& reason) {
        write_text(folder_ / "bad.gltf", text);
        expect_refused(folder_ / "bad.gltf", place, reason);
    }
    void expect_bytes_refused(const Bytes& bytes, const std::string& reason) {
        write_bytes(folder_ / "bad.glb", bytes);
        expect_refused(folder_ / "bad.glb", "GLB container", reason);
    }
    void expect_draft_refused(GltfDraft draft, const std::string& place, const std::string& reason) {
        expect_text_refused(draft.to_text(), place, reason);
    }

    ScratchFolder folder_;
};

void put_u32(Bytes& bytes, std::size_t offset, std::uint32_t value) {
    std::memcpy(&bytes.at(offset), &value, 4);
}
std::uint32_t get_u32(const Bytes& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes.at(offset), 4);
    return value;
}

TEST_F(GltfBadFile, S12_14_S13_1_FilesBeyondTwoGigabytes) {
    write_text(folder_ / "huge.gltf", triangle_draft().to_text());
    fs::resize_file(folder_ / "huge.gltf", std::uintmax_t{1} << 31);  // a hole: no room on the disk
    expect_refused(folder_ / "huge.gltf", "", "has 2147483648 bytes, more than 2147483647");
}

TEST_F(GltfBadFile, MissingFolderPipe) {
    expect_refused(folder_ / "absent.gltf", "", "file not found");
    expect_refused(folder_.path(), "", "not a regular file");
    ASSERT_EQ(::mkfifo((folder_ / "pipe.gltf").c_str(), 0600), 0);
    expect_refused(folder_ / "pipe.gltf", "", "not a regular file");
}

TEST_F(GltfBadFile, S13_1_Text) {
    expect_text_refused("", "line 1, column 1", "not valid JSON");
    expect_text_refused("null", "", "must be an object");
    expect_text_refused("[]", "", "must be an object");
    expect_text_refused("{\"asset\":", "line 1, column 10", "not valid JSON");
    expect_text_refused("{\"asset\":{\"version\":\"2.0\"},\n\"x\":1,}", "line 2, column 6",
                        "this comma is one too many");
    const std::string more = full_draft().to_text() + "x";
    expect_text_refused(more, "line 1, column " + std::to_string(more.size()), "not valid JSON");
    expect_text_refused("{\"asset\":{\"version\":\"2.0\"},\"x\":NaN}", "line 1, column 32", "not valid JSON");
    expect_text_refused("{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}", "line 1, column 36", "too large for a double");
    expect_text_refused("{\"asset\":{\"version\":\"2.\xc3\x28\"}}", "line 1, column 25", "UTF-8");
    expect_text_refused("{\"asset\":{\"version\":\"2.\xed\xa0\x80\"}}", "line 1, column 25", "UTF-8");
    expect_text_refused("{\"asset\":{\"version\":\"2.\\ud800\"}}", "line 1, column 30", "not valid JSON");
}

TEST_F(GltfBadFile, S12_5_S13_1_NestingIsLimitedWhateverCarriesIt) {
    const auto nested = [](int depth) {
        const auto count = static_cast<std::size_t>(depth);
        return "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(count, '[') + std::string(count, ']') + "}";
    };
    expect_text_refused(nested(100000), "", "nested more than 128 deep");
    expect_text_refused(nested(128), "", "nested more than 128 deep");
    expect_text_refused(std::string(50'000'000, '['), "", "holds so many values");
    write_text(folder_ / "fine.gltf", nested(127));
    Scene scene;
    append_gltf(folder_ / "fine.gltf", scene, no_index, 0);
    // Brackets inside strings do not count.
    write_text(folder_ / "text.gltf",
               "{\"asset\":{\"version\":\"2.0\",\"generator\":\"\\\"" + std::string(500, '[') + "\"}}");
    append_gltf(folder_ / "text.gltf", scene, no_index, 0);
}

TEST_F(GltfBadFile, S12_4_S13_1_Containers) {
    const Bytes good = full_draft().to_glb();
    const std::uint32_t json_length = get_u32(good, 12);
    const auto changed = [&](std::size_t offset, std::uint32_t value) {
        Bytes bytes = good;
        put_u32(bytes, offset, value);
        return bytes;
    };
    expect_bytes_refused(changed(4, 1), "version 1 is not supported");
    expect_bytes_refused(changed(4, 3), "version 3 is not supported");
    expect_bytes_refused(changed(8, 12), "the header says 12 bytes");
    expect_bytes_refused(changed(8, static_cast<std::uint32_t>(good.size() + 8)), "the header says");
    expect_bytes_refused(changed(12, 0xffffffffu), "claims 4294967295 bytes");
    expect_bytes_refused(changed(12, json_length + 1), "no multiple of 4");
    expect_bytes_refused(changed(16, 0x004e4942), "the first chunk is not JSON");
    expect_bytes_refused(changed(20 + json_length + 4, 0x4e4f534a), "a second JSON chunk");
    // The BIN chunk claims eight bytes too many.
    expect_bytes_refused(changed(20 + json_length, get_u32(good, 20 + json_length) + 8), "bytes, ");
    expect_bytes_refused(Bytes(good.begin(), good.begin() + 15), "ends inside its header");

    Bytes cut = good;
    cut.resize(cut.size() - 4);
    put_u32(cut, 8, static_cast<std::uint32_t>(cut.size()));
    expect_bytes_refused(cut, "are left");

    GltfDraft draft = full_draft();
    draft.set_length();
    draft.json["buffers"][0]["byteLength"] = draft.buffer.size() + 100;
    write_bytes(folder_ / "short.glb", draft.to_glb());
    expect_refused(folder_ / "short.glb", "/buffers/0", "the BIN chunk has");
}

/// Found only after nodes and meshes were read: the scene stays as it was.
TEST_F(GltfBadFile, S13_7_S13_10_KF11_KeyTimes) {
    const auto with_times = [](std::vector<float> times) {
        GltfDraft draft = triangle_draft();
        const std::vector<float> values(3 * times.size(), 1.0f);
        draft.animate(0, "scale", times, values);
        return draft;
    };
    const std::string place = "/animations/0/samplers/0";
    expect_draft_refused(with_times({0, 2, 1}), place, "key 2 lies at 1 s, the one before at 2 s");
    expect_draft_refused(with_times({-1, 0}), place, "must not be negative");
    expect_draft_refused(with_times({0, float_nan}), "/accessors/2", "element 1 is nan");
    expect_draft_refused(with_times({0, float_infinity}), "/accessors/2", "element 1 is inf");
}

TEST_F(GltfBadFile, KF10_DuplicateKeyTimes) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "scale", {0, 1, 1}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
    expect_draft_refused(draft, "/animations/0/samplers/0", "must strictly increase");
}

TEST_F(GltfBadFile, KF05_ZeroOrNaNRotationKey) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0});
    expect_draft_refused(draft, "/animations/0/samplers/0: node 0 \"node0\" key 1", "is zero");
    GltfDraft nan = triangle_draft();
    nan.animate(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, float_nan, 0, 1});
    expect_draft_refused(nan, "/accessors/3", "element 1 is nan");
}

/// The files exist, so that only the rule can refuse them.
TEST_F(GltfBadFile, S12_2_S12_3_UrisStayInTheFilesFolder) {
    const Bytes data = triangle_draft().buffer;
    fs::create_directories(folder_ / "scene/inner");
    write_bytes(folder_ / "outside.bin", data);
    write_bytes(folder_ / "scene/inside.bin", data);
    write_bytes(folder_ / "scene/name", data);
    fs::create_symlink(folder_ / "outside.bin", folder_ / "scene/link.bin");
    fs::create_directory_symlink(folder_.path(), folder_ / "scene/up");
    fs::create_symlink("inside.bin", folder_ / "scene/harmless.bin");
    ASSERT_EQ(::mkfifo((folder_ / "scene/pipe.bin").c_str(), 0600), 0);
    const auto with_uri = [&](const std::string& uri) {
        GltfDraft draft = triangle_draft();
        draft.json["buffers"] = {{{"byteLength", data.size()}, {"uri", uri}}};
        write_text(folder_ / "scene/uri.gltf", draft.json.dump());
        return folder_ / "scene/uri.gltf";
    };
    const std::vector<std::pair<std::string, std::string>> refused = {
        {"../outside.bin", "leads out"},
        {"%2e%2e%2foutside.bin", "leads out"},
        {"inner/../../outside.bin", "leads out"},
        {"link.bin", "leads out"},
        {"up/outside.bin", "leads out"},
        {"absent/../../outside.bin", "leads out"},
        {(folder_ / "outside.bin").string(), "absolute"},
        {"%2Fetc%2Fhostname", "absolute"},
        {"file:///etc/hostname", "only relative paths"},
        {"http://example.org/a.bin", "only relative paths"},
        {"..\\outside.bin", "backslashes"},
        {"inside.bin%5C", "backslashes"},
        {"name%00.bin", "control characters"},
        {"inside.bin%0A", "control characters"},
        {"inside.bin%7f", "control characters"},
        {"inside.bin%", "broken %"},
        {"inside.bin%2", "broken %"},
        {"inside.bin%zz", "broken %"},
        {".", "leads out"},
        {"inner", "not a regular file"},
        {"pipe.bin", "not a regular file"},
        {"absent.bin", "file not found"},
        {std::string(5000, 'a'), "cannot be resolved"},
        {"", "empty"},
    };
    for (const auto& [uri, reason] : refused) {
        SCOPED_TRACE(uri);
        expect_refused(with_uri(uri), "/buffers/0/uri", reason);
    }
    for (const std::string uri :
         {"inside.bin", "./inside.bin", "inner/../inside.bin", "harmless.bin", "%69nside.bin"}) {
        Scene scene;
        append_gltf(with_uri(uri), scene, no_index, 0);
        EXPECT_EQ(scene.nodes.size(), 1u) << uri;
    }
}

TEST_F(GltfBadFile, ImageFilesStayInTheFolderToo) {
    GltfDraft draft = textured_draft(folder_, true);
    fs::create_directory(folder_ / "scene");
    draft.json["images"][0]["uri"] = "../image.png";
    write_text(folder_ / "scene/image.gltf", draft.to_text());
    expect_refused(folder_ / "scene/image.gltf", "/images/0/uri", "leads out");
    draft.json.erase("materials");  // used by nothing, the verdict is the same
    draft.primitive().erase("material");
    write_text(folder_ / "scene/image.gltf", draft.to_text());
    expect_refused(folder_ / "scene/image.gltf", "/images/0/uri", "leads out");
}

TEST_F(GltfBadFile, S13_9_NamesInMessagesAreEscapedAndShort) {
    GltfDraft draft = full_draft();
    draft.json["extensionsRequired"] = {std::string(100000, 'x') + "\n"};
    expect_draft_refused(draft, "/extensionsRequired/0", "xxx...");
    draft.json["extensionsRequired"] = {"a\nb"};
    expect_draft_refused(draft, "/extensionsRequired/0", "a\\x0ab");
}

TEST_F(GltfBadFile, S13_4_S13_5_SmallFilesThatMultiply) {
    // 5000 nodes times 5000 primitives.
    GltfDraft draft = triangle_draft();
    const Json primitive = draft.primitive();
    for (int i = 0; i < 5000; ++i) draft.json["meshes"][0]["primitives"].push_back(primitive);
    repeat_node(draft, 5000, {{"mesh", 0}});
    expect_draft_refused(draft, "/nodes/1999", "more than 10000000 instances");

    // The same 50,000 vertices in every primitive: three gigabytes from one megabyte.
    const int many = draft.add_accessor(std::vector<float>(150000, 1.0f), "VEC3", 3);
    for (Json& each : draft.json["meshes"][0]["primitives"]) each["attributes"]["POSITION"] = many;
    expect_draft_refused(draft, "/accessors/2", "too many bytes for its size");
}
}  // namespace
}  // namespace aleph
