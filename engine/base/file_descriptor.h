#pragma once
// An open file, closed at the end of the scope, and locks of its bytes.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

namespace aleph {

class FileDescriptor {
  public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    ~FileDescriptor() { close(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }

    /// Writes all of the bytes; the system may take them in pieces. Returns whether that worked; errno says why not.
    bool write(std::string_view bytes) const {
        constexpr std::size_t most = std::size_t{1} << 26;
        while (!bytes.empty()) {
            const ssize_t written = ::write(fd_, bytes.data(), std::min(bytes.size(), most));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return true;
    }
    /// Locks a byte, which need not exist, or ends its lock (open file description locks of Linux). The system ends
    /// locks with the process, however that ends.
    /// @param kind  F_RDLCK, F_WRLCK or F_UNLCK
    /// @return 0, or the error; EAGAIN where another open file has the lock
    int set_lock(off_t byte, short kind, bool wait = false) const {
        struct flock lock {};
        lock.l_type = kind;
        lock.l_whence = SEEK_SET;
        lock.l_start = byte;
        lock.l_len = 1;
        while (::fcntl(fd_, wait ? F_OFD_SETLKW : F_OFD_SETLK, &lock) != 0) {
            if (errno != EINTR) return errno == EACCES ? EAGAIN : errno;
        }
        return 0;
    }
    int get() const { return fd_; }  ///< below 0: not open
    /// Returns whether that worked.
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

}  // namespace aleph
