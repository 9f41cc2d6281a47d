#pragma once
// Where tests find the repository, its assets and the programs that were built.

#include <filesystem>
#include <string>

namespace aleph {

/// Root of the source tree.
std::filesystem::path source_folder();

/// Small files of our own: tests/assets.
std::filesystem::path own_assets_folder();

/// Files that other programs wrote. They are not part of the repository: the folder may be absent.
std::filesystem::path assets_folder();

/// The reason of a skipped test; tests/results.sh knows its first words.
std::string missing_asset(const std::filesystem::path& file);

/// Folder of the build, which holds the programs.
std::filesystem::path build_folder();

/// Path of a program of this build, e.g. "aleph" or "make_scenes".
std::string program_path(const std::string& name);

}  // namespace aleph
