#include "engine/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "engine/base/errors.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& path) {
    return printable(path.string(), 4096);
}

/// The file to write: `path`, or what it links to. Refuses what cannot be replaced.
fs::path checked_target(const fs::path& path) {
    if (!path.has_filename()) throw OutputError(shown(path), "this is a folder, not a file name");
    std::error_code error;
    const fs::path target = follow_links(path);
    if (fs::is_symlink(target, error)) fail_output(path, "cannot follow the link", ELOOP);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const bool is_folder = fs::is_directory(folder, error);
    if (error && error != std::errc::no_such_file_or_directory)
        fail_output(path, "cannot use its folder", error.value());
    if (!is_folder) throw OutputError(shown(path), fmt::format("the folder '{}' does not exist", shown(folder)));
    const fs::file_status status = fs::status(target, error);
    if (fs::exists(status)) {
        if (fs::is_directory(status)) throw OutputError(shown(path), "this is a folder");
        if (!fs::is_regular_file(status)) throw OutputError(shown(path), "exists and is not a regular file");
        if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
            fail_output(path, "cannot replace the existing file", errno);
    }
    return target;
}

void flush_to_disk(const fs::path& file, const fs::path& named) {
    FileDescriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (fd.get() < 0) fail_output(named, "cannot re-open the temporary file", errno);
    if (::fsync(fd.get()) != 0) fail_output(named, "cannot flush to disk", errno);
}

/// Processes of other hosts and containers may have the same number.
fs::path temporary_path(const fs::path& target) {
    static const std::uint32_t own = std::random_device()();
    return hidden_beside(target, fmt::format("{}{:010}.part", ::getpid(), own));
}

bool is_named(const FileDescriptor& file, const fs::path& path) {
    struct stat opened {
    }, named{};
    return ::fstat(file.get(), &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

void create_folder_of(const fs::path& path) {
    if (!path.has_parent_path()) return;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) fail_output(path, "cannot create its folder", error.value());
}

/// Every step is checked. write_atomically flushes them.
void write_bytes(const fs::path& file, std::string_view bytes, const fs::path& named) {
    FileDescriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (fd.get() < 0) fail_output(named, "cannot create a file in this folder", errno);
    if (!fd.write(bytes)) fail_output(named, "cannot write", errno);
    if (!fd.close()) fail_output(named, "cannot close", errno);
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error || size != bytes.size()) {
        throw OutputError(shown(named),
                          fmt::format("{} bytes reached the disk, not {}", error ? 0 : size, bytes.size()));
    }
}

/// write_atomically.
void replace_file(const fs::path& path, const std::function<void(const fs::path& temporary)>& write,
                  bool may_be_empty) {
    const fs::path target = checked_target(path);
    const fs::path temporary = temporary_path(target);
    const LockedFile held = open_locked(temporary, path);
    try {
        write(temporary);
        std::error_code error;
        if (!may_be_empty && fs::file_size(temporary, error) == 0)
            throw OutputError(shown(path), "nothing was written");
        flush_to_disk(temporary, path);
        if (::rename(temporary.c_str(), target.c_str()) != 0)
            fail_output(path, "cannot rename the temporary file", errno);
    } catch (...) {
        ::unlink(temporary.c_str());
        throw;
    }
    // The name is part of the folder. Some file systems refuse to flush folders; the file is complete either way.
    const FileDescriptor folder(
        ::open(target.has_parent_path() ? target.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() >= 0) ::fsync(folder.get());
}

}  // namespace

fs::path follow_links(fs::path path) {
    constexpr int most_links = 40;  // as the system has it
    std::error_code error;
    for (int i = 0; i < most_links && fs::is_symlink(path, error); ++i) {
        const fs::path target = fs::read_symlink(path, error);
        if (error) break;
        path = path.parent_path() / target;
    }
    return path;
}

fs::path hidden_beside(const fs::path& path, std::string_view suffix) {
    constexpr std::size_t longest = 255, kept = 150;
    const std::string name = path.filename().string();
    std::string hidden = fmt::format(".{}.{}", name, suffix);
    if (hidden.size() > longest && name.size() <= longest)
        hidden = fmt::format(".{}-{:016x}.{}", name.substr(0, kept), std::hash<std::string>()(name), suffix);
    return path.parent_path() / hidden;
}

std::string without_process(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(".part")) return {};
    name.remove_suffix(std::string_view(".part").size());
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || name.find_first_not_of("0123456789", dot + 1) != std::string_view::npos)
        return {};
    return std::string(name.substr(0, dot + 1));
}

LockedFile open_locked(const fs::path& file, const fs::path& named) {
    for (;;) {
        LockedFile opened{FileDescriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))};
        if (opened.file.get() < 0) fail_output(named, "cannot create a file in this folder", errno);
        opened.locked = opened.file.set_lock(0, F_WRLCK, true) == 0;
        // Another process may have removed the file before the lock was given.
        if (!opened.locked || is_named(opened.file, file)) return opened;
    }
}

void remove_leftovers(const fs::path& path) {
    const fs::path target = follow_links(path), folder = target.parent_path();
    const std::string own = hidden_beside(target, "").filename().string();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
        if (without_process(entry.path().filename().string()) != own) continue;
        const FileDescriptor file(::open(entry.path().c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
        if (file.get() >= 0 && file.set_lock(0, F_WRLCK) == 0 && is_named(file, entry.path()))
            ::unlink(entry.path().c_str());
    }
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path& temporary)>& write) {
    replace_file(path, write, false);
}

void try_output(const fs::path& path) {
    create_folder_of(path);
    const fs::path temporary = temporary_path(checked_target(path));
    const LockedFile held = open_locked(temporary, path);  // not while another thread writes it
    ::unlink(temporary.c_str());
}

void create_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail_output(folder, "cannot create the folder", error.value());
}

void write_file(const fs::path& path, std::string_view bytes) {
    const auto write = [&](const fs::path& temporary) { write_bytes(temporary, bytes, path); };
    replace_file(path, write, bytes.empty());
}

}  // namespace aleph
