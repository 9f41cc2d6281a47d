#pragma once
// Which build of the program runs, to recognise results of another one.

#include <string>

namespace aleph {

/// The version and the SHA-1 of the file that holds this code: the program, or the Python module.
/// @throws InputError if the file cannot be read
const std::string& program_build();

}  // namespace aleph
