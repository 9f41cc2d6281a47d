#pragma once
// Answers of commands of `aleph`, in this process (Ran) or in one of their own (Ended).

#include <gmock/gmock.h>

#include "tests/support/run_command.h"
#include "tests/support/started_program.h"

namespace aleph {

using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

inline Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Expects an exit code, and a part of what is printed on standard error.
inline void expect_answer(const Ran& ran, int code, const std::string& part) {
    EXPECT_EQ(ran.code, code) << part;
    EXPECT_THAT(ran.errors, HasSubstr(part));
}
inline void expect_answer(const Ended& ended, int code, const std::string& part) {
    EXPECT_EQ(ended.code, code) << part;
    EXPECT_THAT(ended.err, HasSubstr(part));
}

/// Runs the program in processes of its own.
class ProgramTest : public testing::Test {
  protected:
    Ended run(const Words& words) const { return StartedProgram(words, folder_ / "log").wait(); }

    const ScratchFolder folder_;
};

}  // namespace aleph
