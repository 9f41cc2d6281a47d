#pragma once
// Locks on the frames of an output, so that several processes, also on several machines with a shared folder, do not
// write the same frame, and frames of two renders do not mix.
//
// The locks lie on bytes of one file beside the frames (open file description locks of Linux): the system ends them
// with the process, however that ends. The file holds the fingerprint of what is rendered, and is removed by the last
// process that uses it.

#include <filesystem>
#include <string>

#include "engine/base/file_descriptor.h"

namespace aleph {

class FrameLocks {
  public:
    /// Where the file system has no locks, nothing is locked.
    /// @param file      the lock file
    /// @param identity  what is rendered: processes that render the same may share the output
    /// @throws OutputError if another process renders something else here, or if the file cannot be made
    FrameLocks(std::filesystem::path file, const std::string& identity);
    ~FrameLocks();
    FrameLocks(const FrameLocks&) = delete;
    FrameLocks& operator=(const FrameLocks&) = delete;

    /// Locks a frame. Returns whether no other process has it.
    bool lock(int frame);
    void unlock(int frame);

  private:
    bool open();

    std::filesystem::path file_;
    FileDescriptor lock_;
    bool works_ = true;
};

}  // namespace aleph
