#include "render/cli/support/frame_locks.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"

namespace aleph {

namespace {

// Bytes of the file that are locked; they need not exist.
constexpr off_t gate_byte = 0;                       // while a process comes or goes
constexpr off_t user_byte = 1;                       // shared by all that render here
constexpr off_t frame_byte = (off_t{1} << 31) + 16;  // plus the frame, which may be below 0

/// @param kind  F_RDLCK, F_WRLCK or F_UNLCK
/// @return 0, or the error; EAGAIN where another process has the lock
int set_lock(int fd, off_t byte, short kind, bool wait = false) {
    struct flock lock {};
    lock.l_type = kind;
    lock.l_whence = SEEK_SET;
    lock.l_start = byte;
    lock.l_len = 1;
    while (::fcntl(fd, wait ? F_OFD_SETLKW : F_OFD_SETLK, &lock) != 0) {
        if (errno != EINTR) return errno == EACCES ? EAGAIN : errno;
    }
    return 0;
}

[[noreturn]] void fail_lock(const std::filesystem::path& file, const char* what, int error) {
    throw OutputError(printable(file.string(), 4096),
                      fmt::format("{}: {}", what, std::generic_category().message(error)));
}

std::string read_all(int fd) {
    std::string text(256, '\0');
    const ssize_t size = ::pread(fd, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
}

bool write_all(int fd, const std::string& text) {
    return ::ftruncate(fd, 0) == 0 && ::pwrite(fd, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

}  // namespace

bool FrameLocks::open() {
    for (;;) {
        lock_ = FileDescriptor(::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (lock_.get() < 0) fail_lock(file_, "cannot create a file in this folder", errno);
        if (set_lock(lock_.get(), gate_byte, F_WRLCK, true) != 0) return false;
        // Another process may have removed the file before the lock was given.
        struct stat opened {
        }, named{};
        if (::fstat(lock_.get(), &opened) == 0 && ::stat(file_.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
            opened.st_ino == named.st_ino) {
            return true;
        }
    }
}

FrameLocks::FrameLocks(std::filesystem::path file, const std::string& identity) : file_(std::move(file)) {
    works_ = open();
    if (!works_) {
        ::unlink(file_.c_str());
        return;
    }
    if (set_lock(lock_.get(), user_byte, F_WRLCK) == 0) {
        if (!write_all(lock_.get(), identity)) {
            const int error = errno;
            ::unlink(file_.c_str());
            fail_lock(file_, "cannot write", error);
        }
    } else if (read_all(lock_.get()) != identity) {
        const std::string folder = file_.has_parent_path() ? file_.parent_path().string() : ".";
        throw OutputError(printable(folder, 4096),
                          "another process renders these files from another scene or with other settings; wait for it, "
                          "or give another --output");
    }
    set_lock(lock_.get(), user_byte, F_RDLCK);
    set_lock(lock_.get(), gate_byte, F_UNLCK);
}

FrameLocks::~FrameLocks() {
    if (!works_) return;
    set_lock(lock_.get(), gate_byte, F_WRLCK, true);
    if (set_lock(lock_.get(), user_byte, F_WRLCK) == 0) ::unlink(file_.c_str());
}

bool FrameLocks::lock(int frame) {
    return !works_ || set_lock(lock_.get(), frame_byte + frame, F_WRLCK) != EAGAIN;
}

void FrameLocks::unlock(int frame) {
    if (works_) set_lock(lock_.get(), frame_byte + frame, F_UNLCK);
}

}  // namespace aleph
