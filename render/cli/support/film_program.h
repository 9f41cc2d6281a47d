#pragma once
// Another program, started without a shell and fed through its standard input.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/files.h"

namespace aleph {

/// The executable file of that name in a folder of PATH; empty: there is none.
std::filesystem::path find_program(const std::string& name);

struct ProgramEnd {
    int code = -1;          ///< exit code, or -1 where a signal ended it
    bool took_all = false;  ///< it read all that it was given
    std::string errors;     ///< the end of what it printed on standard error
};

/// Runs a program in a process group of its own, so that Ctrl-C reaches it through `check` alone. It is killed if
/// something throws; where this process dies, its standard input ends.
/// @param next   the next piece of its standard input; empty: the end
/// @param check  called several times a second; may throw
/// @throws OutputError naming the program if it cannot be started; what `next` and `check` throw
ProgramEnd run_fed(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::function<Bytes()>& next, const std::function<void()>& check);

}  // namespace aleph
