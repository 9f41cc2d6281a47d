#pragma once
// Scene files as short texts: read, written again, and refused with the expected place and reason.

#include "engine/scene_file/scene_text.h"
#include "tests/support/test.h"

namespace aleph {

/// @param body  what follows the version: nothing, or a comma and more
inline Scene read(const std::string& body) {
    return read_scene_text("{\"aleph\": 1" + body + "}", "test.json").scene;
}

/// @param node  what stands in the only node
inline Scene read_node(const std::string& node) {
    return read(", \"nodes\": [{" + node + "}]");
}

/// The scene after it was written as a scene file and read again.
inline Scene again(const Scene& scene) {
    return read_scene_text(write_scene_text(scene, "test.json"), "test.json").scene;
}

struct BadScene {
    std::string text;   ///< of the file
    std::string place;  ///< of the error, exactly
    std::string word;   ///< of its reason
};

inline void expect_refused(const BadScene& c) {
    SCOPED_TRACE(c.text.substr(0, 200));
    const Refusal found = find_refusal([&] { read_scene_text(c.text, "broken.json"); });
    expect_refusal(found, "broken.json", c.place, c.word);
    EXPECT_LT(found.message.size(), 700u);
}

inline void expect_all_refused(const std::vector<BadScene>& cases) {
    for (const BadScene& c : cases) expect_refused(c);
}

inline BadScene scene(const std::string& body, const std::string& place, const std::string& word) {
    return {"{\"aleph\": 1, " + body + "}", place, word};
}

inline BadScene node(const std::string& body, const std::string& place, const std::string& word) {
    return scene("\"nodes\": [{" + body + "}]", "/nodes/0" + place, word);
}

inline BadScene shape(const std::string& body, const std::string& place, const std::string& word) {
    return node("\"shape\": {" + body + "}", "/shape" + place, word);
}

inline BadScene material(const std::string& body, const std::string& place, const std::string& word) {
    return scene("\"materials\": {\"felt\": {" + body + "}}", "/materials/felt" + place, word);
}

}  // namespace aleph
