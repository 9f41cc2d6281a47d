#pragma once
// Broken scene files as short texts, with the expected place and reason of the error.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/base/errors.h"
#include "engine/scene_file/scene_text.h"

namespace aleph {

struct BadScene {
    std::string text;   ///< of the file
    std::string place;  ///< of the error, exactly
    std::string word;   ///< of its reason
};

inline void expect_refused(const BadScene& c) {
    try {
        read_scene_text(c.text, "broken.json");
        ADD_FAILURE() << "was read: " << c.text.substr(0, 200);
    } catch (const InputError& error) {
        EXPECT_EQ(error.file(), "broken.json");
        EXPECT_EQ(error.place(), c.place) << error.what() << "\n  in " << c.text.substr(0, 200);
        EXPECT_NE(error.reason().find(c.word), std::string::npos) << error.what() << "\n  has no " << c.word;
        EXPECT_LT(std::string(error.what()).size(), 700u);
    }
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
