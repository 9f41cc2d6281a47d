#include "render/cli/support/frame_claims.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <exception>
#include <map>
#include <string_view>
#include <system_error>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

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

/// The name of a temporary file (write_atomically) without the process and ".part"; empty: it is none.
std::string without_process(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(".part")) return {};
    name.remove_suffix(std::string_view(".part").size());
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || name.find_first_not_of("0123456789", dot + 1) != std::string_view::npos)
        return {};
    return std::string(name.substr(0, dot + 1));
}

/// Frames of one file name are one frame.
std::string identity_of(const ClaimedOutput& output) {
    if (output.file(0) != output.file(1)) return output.identity;
    return output.identity + " " + output.fingerprint(output.frames.front());
}

}  // namespace

bool FrameLocks::open() {
    for (;;) {
        lock_ = FileDescriptor(::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (lock_.get() < 0) fail_output(file_, "cannot create a file in this folder", errno);
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

FrameLocks::FrameLocks(fs::path file, const std::string& identity) : file_(std::move(file)) {
    works_ = open();
    if (!works_) {
        ::unlink(file_.c_str());
        return;
    }
    if (set_lock(lock_.get(), user_byte, F_WRLCK) == 0) {
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
