#pragma once
// Files that are written whole or not at all, whatever interrupts the program.

#include <filesystem>
#include <functional>
#include <string_view>

namespace aleph {

/// Runs write(temporary path), flushes the file to the disk, then renames it to `path`. The temporary file is
/// `.name.<process id><ten random digits>.part` beside the target and is removed if anything throws. An existing file
/// is replaced, unless it is read-only or not a regular file; a symbolic link is followed.
/// @throws OutputError naming `path`; whatever `write` throws
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The file that a path means: symbolic links in its last part are followed, those to missing files too.
std::filesystem::path follow_links(std::filesystem::path path);

/// The file `.NAME.SUFFIX` beside `path`. A name that would be too long for a file system is shortened, so that a
/// number made from all of it tells it apart.
std::filesystem::path hidden_beside(const std::filesystem::path& path, std::string_view suffix);

/// Refuses now what write_atomically would refuse later: creates the folder of `path`, with its parents, if it is
/// missing, creates the temporary file and removes it.
/// @throws OutputError naming `path`
void try_output(const std::filesystem::path& path);

/// Creates a folder, with its parents, if it is missing.
/// @throws OutputError naming it
void create_folder(const std::filesystem::path& folder);

/// Writes the bytes to `path`, whole or not at all.
/// @throws OutputError naming `path`
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace aleph
