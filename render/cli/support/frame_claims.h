#pragma once
// Which frames a process is to make: with --resume those that are not finished, divided among the processes that render
// them, also on several machines with a shared folder. Locks keep two from writing the same frame, and frames of two
// renders from mixing.

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/file_descriptor.h"

namespace aleph {

/// Locks on bytes of one file beside the frames (FileDescriptor::set_lock). The file holds the fingerprint of what is
/// rendered, and is removed by the last process that uses it.
class FrameLocks {
  public:
    /// Where the file system has no locks, nothing is locked.
    /// @param file      the lock file
    /// @param identity  what is rendered: processes that render the same may share the output
    /// @throws OutputError if another process renders something else here, or if the file cannot be made
    FrameLocks(std::filesystem::path file, const std::string& identity);
    ~FrameLocks();

    /// Locks a frame. Returns whether no other process has it.
    bool lock(int frame);
    void unlock(int frame);

  private:
    std::filesystem::path file_;
    FileDescriptor lock_;
    bool works_ = true;
};

/// Where the state of a frame is kept while it is made: ".name.0020.exr.checkpoint".
std::filesystem::path checkpoint_file(const std::filesystem::path& file);

/// Frames and their files.
struct ClaimedOutput {
    std::vector<int> frames;
    std::function<std::filesystem::path(int frame)> file;
    std::function<std::string(int frame)> fingerprint;  ///< of a frame's file: SHA-1
    std::string identity;                               ///< what all of them have in common
    bool resume = false;                                ///< finished frames are kept
    /// Returns whether the film of the frames is made: they are finished then. May be empty.
    std::function<bool()> is_used = {};
};

enum class Claim {
    ours,      ///< to be made now
    finished,  ///< its file is whole and of this scene, these settings and this program
    busy,      ///< another process makes it
};

class FrameClaims {
  public:
    /// Without `resume` all frames are ours from now on. Temporary files that killed processes have left, and states of
    /// frames that are finished, are removed, now and at the end.
    /// @throws OutputError if another process makes one of them, or renders something else into the same files
    explicit FrameClaims(ClaimedOutput output);
    ~FrameClaims();

    /// Claims a frame, unless it is finished or busy.
    Claim claim(int frame);

    /// Ends a claim: the frame's file is written.
    void release(int frame);

    /// The file of a frame is decoded once, so that damage anywhere in it is found.
    bool is_finished(int frame);
    const ClaimedOutput& output() const { return output_; }
    /// Frames with a file that was there before and could not be kept: damaged, or of something else.
    int replaced() const { return replaced_; }

  private:
    void remove_leftovers();

    const ClaimedOutput output_;
    FrameLocks locks_;
    std::set<int> finished_;  ///< found whole
    int replaced_ = 0;
};

}  // namespace aleph
