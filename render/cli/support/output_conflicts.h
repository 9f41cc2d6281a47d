#pragma once
// Outputs that would replace a file which the same command reads or writes.

#include <filesystem>
#include <string>
#include <vector>

namespace aleph {

struct OutputFile {
    std::filesystem::path path;  ///< empty: none
    std::string option;          ///< that names it, for messages
};

/// Called before anything is written. Files are the same by identity: another spelling of a path, a symbolic link, and
/// for files that are read a hard link too. Writing one of two hard links leaves the other as it is, so outputs that
/// are hard links of each other are allowed.
/// @param inputs  files that the command reads; empty paths are left out
/// @throws InputError (place: the option)
void refuse_overwriting(const std::vector<std::filesystem::path>& inputs, const std::vector<OutputFile>& outputs);

}  // namespace aleph
