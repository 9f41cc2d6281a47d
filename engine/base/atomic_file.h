#pragma once
// Files that are written whole or not at all, whatever interrupts the program.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/base/file_descriptor.h"

namespace aleph {

/// Runs write(temporary path), flushes the file to the disk, then renames it to `path`. The temporary file is
/// `.name.<process id><ten random digits>.part` beside the target and is removed if anything throws; it is locked while
/// it is written. An existing file is replaced, unless it is read-only or not a regular file; a symbolic link is
/// followed.
/// @throws OutputError naming `path`, also where nothing was written; whatever `write` throws
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Removes temporary files of `path` that killed processes have left: those that no process has locked.
void remove_leftovers(const std::filesystem::path& path);

/// The name of a temporary file (write_atomically) without the process and ".part": `.name.`. Empty: it is none.
std::string without_process(std::string_view name);

/// A file that is open, made where it is missing.
struct LockedFile {
    FileDescriptor file;
    bool locked = false;  ///< its first byte; false where the file system has no locks
};

/// Waits for the lock. A file that another process removes meanwhile is made again.
/// @param named  for the message
/// @throws OutputError naming `named`
LockedFile open_locked(const std::filesystem::path& file, const std::filesystem::path& named);

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
