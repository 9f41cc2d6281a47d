#include "render/cli/support/frame_claims.h"

#include <fcntl.h>

#include <cerrno>
#include <exception>
#include <map>
#include <system_error>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

// Bytes of the file that are locked; they need not exist.
constexpr off_t gate_byte = 0;                       // of open_locked: while a process comes or goes
constexpr off_t user_byte = 1;                       // shared by all that render here
constexpr off_t frame_byte = (off_t{1} << 31) + 16;  // plus the frame, which may be below 0

std::string read_all(int fd) {
    std::string text(256, '\0');
    const ssize_t size = ::pread(fd, text.data(), text.size(), 0);
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
}

bool write_all(int fd, const std::string& text) {
    return ::ftruncate(fd, 0) == 0 && ::pwrite(fd, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

/// ".name.000#.exr.lock" beside the frames: the same for every list of frames.
fs::path lock_file(const ClaimedOutput& output) {
    const fs::path file = output.file(0), other = output.file(1);
    std::string name = file.filename().string();
    const std::string second = other.filename().string();
    for (std::size_t i = 0; i < name.size() && name.size() == second.size(); ++i) {
        if (name[i] != second[i]) name[i] = '#';
    }
    return hidden_beside(file.parent_path() / name, "lock");
}

/// Frames of one file name are one frame.
std::string identity_of(const ClaimedOutput& output) {
    if (output.file(0) != output.file(1)) return output.identity;
    return output.identity + " " + output.fingerprint(output.frames.front());
}

}  // namespace

FrameLocks::FrameLocks(fs::path file, const std::string& identity) : file_(std::move(file)) {
    LockedFile opened = open_locked(file_, file_);
    lock_ = std::move(opened.file);
    works_ = opened.locked;
    if (!works_) {
        ::unlink(file_.c_str());
        return;
    }
    if (lock_.set_lock(user_byte, F_WRLCK) == 0) {
        if (!write_all(lock_.get(), identity)) {
            const int error = errno;
            ::unlink(file_.c_str());
            fail_output(file_, "cannot write", error);
        }
    } else if (read_all(lock_.get()) != identity) {
        const std::string folder = file_.has_parent_path() ? file_.parent_path().string() : ".";
        throw OutputError(printable(folder, 4096),
                          "another process renders these files from another scene or with other settings; wait for it, "
                          "or give another --output");
    }
    lock_.set_lock(user_byte, F_RDLCK);
    lock_.set_lock(gate_byte, F_UNLCK);
}

FrameLocks::~FrameLocks() {
    if (!works_) return;
    lock_.set_lock(gate_byte, F_WRLCK, true);
    if (lock_.set_lock(user_byte, F_WRLCK) == 0) ::unlink(file_.c_str());
}

bool FrameLocks::lock(int frame) {
    return !works_ || lock_.set_lock(frame_byte + frame, F_WRLCK) != EAGAIN;
}

void FrameLocks::unlock(int frame) {
    if (works_) lock_.set_lock(frame_byte + frame, F_UNLCK);
}

fs::path checkpoint_file(const fs::path& file) {
    return hidden_beside(file, "checkpoint");
}

FrameClaims::FrameClaims(ClaimedOutput output)
    : output_(std::move(output)), locks_(lock_file(output_), identity_of(output_)) {
    if (!output_.resume) {
        for (const int frame : output_.frames) {
            if (locks_.lock(frame)) continue;
            throw OutputError(printable(output_.file(frame).string(), 4096),
                              "another process makes this frame; with --resume both divide the frames");
        }
    }
    remove_leftovers();
}

FrameClaims::~FrameClaims() {
    try {
        remove_leftovers();
    } catch (const std::exception&) {  // the next render of these frames tries again
    }
}

bool FrameClaims::is_finished(int frame) {
    if (!output_.resume) return false;
    if (finished_.contains(frame) || (output_.is_used && output_.is_used())) return true;
    const fs::path file = output_.file(frame);
    const bool is_whole =
        read_picture_text(file, fingerprint_key) == output_.fingerprint(frame) && can_read_image(file);
    if (is_whole) finished_.insert(frame);
    return is_whole;
}

Claim FrameClaims::claim(int frame) {
    if (is_finished(frame)) return Claim::finished;
    if (output_.resume) {
        if (!locks_.lock(frame)) return Claim::busy;
        if (is_finished(frame)) {  // meanwhile
            locks_.unlock(frame);
            return Claim::finished;
        }
        std::error_code error;
        if (fs::exists(output_.file(frame), error)) ++replaced_;
    }
    return Claim::ours;
}

void FrameClaims::release(int frame) {
    if (output_.resume) locks_.unlock(frame);
}

void FrameClaims::remove_leftovers() {
    std::map<std::string, int> frames, states;
    for (const int frame : output_.frames) {
        const fs::path state = checkpoint_file(output_.file(frame));
        for (const fs::path& file : {output_.file(frame), state})
            frames[hidden_beside(file, "").filename().string()] = frame;
        states[state.filename().string()] = frame;
    }
    const fs::path folder = output_.file(output_.frames.front()).parent_path();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        const auto part = frames.find(without_process(name)), state = states.find(name);
        if (part == frames.end() && (state == states.end() || !is_finished(state->second))) continue;
        const int frame = part == frames.end() ? state->second : part->second;
        if (output_.resume && !locks_.lock(frame)) continue;  // being written
        fs::remove(entry.path(), error);
        release(frame);
    }
}

}  // namespace aleph
