#pragma once
// How bad input is refused.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/errors.h"

namespace aleph {

/// The parts of an InputError; all are empty where nothing was refused.
struct Refusal {
    std::string file, place, reason, message;
};

/// The InputError that `work` ends with. Other exceptions pass through.
template <class Work>
Refusal find_refusal(const Work& work) {
    try {
        work();
    } catch (const InputError& error) {
        return {error.file(), error.place(), error.reason(), error.what()};
    }
    return {};
}

/// Expects an InputError of this file and place, with `words` in its reason.
inline void expect_refusal(const Refusal& refusal, const std::string& file, const std::string& place,
                           const std::string& words) {
    EXPECT_NE(refusal.message, "") << "accepted; expected at " << place << ": " << words;
    EXPECT_EQ(refusal.file, file) << refusal.message;
    EXPECT_EQ(refusal.place, place) << refusal.message;
    EXPECT_NE(refusal.reason.find(words), std::string::npos) << refusal.message << "\n  lacks " << words;
}
template <class Work>
void expect_refusal(const Work& work, const std::string& file, const std::string& place, const std::string& words) {
    expect_refusal(find_refusal(work), file, place, words);
}

}  // namespace aleph
