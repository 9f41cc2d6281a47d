#pragma once
// Broken scene files as short texts, with the expected place and reason of the error.

#include "engine/scene_file/scene_text.h"
#include "tests/support/test.h"

namespace aleph {

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

inline BadScene material(const std::string& body, const std::string& place, const std::string& word) {
    return scene("\"materials\": {\"felt\": {" + body + "}}", "/materials/felt" + place, word);
}

}  // namespace aleph
