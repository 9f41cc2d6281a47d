#include "render/cli/support/frame_claims.h"

#include <fmt/format.h>

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
