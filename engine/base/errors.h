#pragma once
// Errors. The library throws them; only the command line prints and exits.

#include <stdexcept>
#include <string>
#include <string_view>

namespace aleph {

/// Text from a file or a user, made safe and short for a message: control bytes escaped, cut at `max_bytes`.
std::string printable(std::string_view text, std::size_t max_bytes = 80);

/// Bad input: a scene, an image, an option. Exit code 2. what() is "file: place: reason", empty parts left out.
class InputError : public std::runtime_error {
  public:
    InputError(std::string file, std::string place, std::string reason);

    const std::string& file() const { return file_; }
    const std::string& place() const { return place_; }  ///< JSON pointer, "node 3", option name, ...
    const std::string& reason() const { return reason_; }

  private:
    std::string file_, place_, reason_;
};

/// A result could not be written (disk full, folder missing or read-only). Exit code 1. what() names the file.
class OutputError : public std::runtime_error {
  public:
    OutputError(const std::string& file, const std::string& reason);
};

/// Throws OutputError: a system call failed. @param error  errno
[[noreturn]] void fail_output(const std::string& file, const char* what, int error);

/// Throws std::logic_error: an invariant of the program does not hold. @param values  the values found, as text
[[noreturn]] void fail_check(const char* expression, const char* file, int line, const std::string& values);

#define ALEPH_CHECK(expression, values)                                                  \
    do {                                                                                 \
        if (!(expression)) ::aleph::fail_check(#expression, __FILE__, __LINE__, values); \
    } while (false)

}  // namespace aleph
