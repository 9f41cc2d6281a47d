#pragma once
// A viewer that shows files as they are written: tev, or another one with its protocol.

#include <filesystem>
#include <set>
#include <string>

namespace aleph {

/// A viewer on this machine. tev's protocol: over TCP, the length of the packet in bytes, 32 bits little
/// endian, these four included; a byte for the operation, 0 to open a file and 1 to read it again; a byte, 1 to bring
/// it to the front; the file's path, ended by 0.
class ImageViewer {
  public:
    /// @param address  "HOST:PORT"
    /// @throws InputError (--viewer) for other text, a port outside 1 to 65535 or a host that is not this one
    explicit ImageViewer(const std::string& address);

    /// Has it show a file. Does nothing where no viewer listens; waits a second at most for one that does not answer.
    void show(const std::filesystem::path& file);

  private:
    std::string host_, port_;
    std::set<std::filesystem::path> shown_;
};

}  // namespace aleph
