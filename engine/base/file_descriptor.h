#pragma once
// An open file, closed at the end of the scope.

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
    int get() const { return fd_; }  ///< below 0: not open
    /// Returns whether that worked.
    bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

}  // namespace aleph
