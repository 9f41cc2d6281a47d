#include "render/pixels/frame_checkpoint.h"

#include <system_error>
#include <utility>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

constexpr std::string_view magic = "alephC1\n";
constexpr std::size_t digest_size = 40;

/// The file without its digest; empty if it is not whole, or there is none.
std::string read_whole(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    const Bytes bytes = read_regular_file(file, file.string(), "");
    std::string text(bytes.begin(), bytes.end());
    if (text.size() < magic.size() + digest_size || !text.starts_with(magic)) return {};
    const std::string digest = text.substr(text.size() - digest_size);
    text.resize(text.size() - digest_size);
    return hash_bytes(text) == digest ? text : std::string();
}

}  // namespace

FrameCheckpoint::FrameCheckpoint(std::filesystem::path file, std::string identity, std::function<bool()> is_due)
    : file_(std::move(file)), identity_(std::move(identity)), is_due_(std::move(is_due)) {
    const std::string text = read_whole(file_);
    if (text.empty()) return;
    ByteReader in(std::string_view(text).substr(magic.size()));
    if (in.read_text() != identity_) return;
    std::vector<Gathers> gathers(std::min(in.read<std::size_t>(), text.size()));
    for (auto& [results, found] : gathers) {
        results = in.read_text();
        found = in.read_text();
    }
    const std::string_view light = in.read_text(), samples = in.read_text();
    if (!in.is_good() || !in.at_end()) return;
    gathers_ = std::move(gathers);
    light_ = light;
    samples_ = samples;
}

void FrameCheckpoint::add_gathers(Gathers gathers) {
    gathers_.push_back(std::move(gathers));
    next_ = gathers_.size();
}

void FrameCheckpoint::end_round() {
    for (; round_ < next_; ++round_) gathers_[round_].found = {};
}

std::string FrameCheckpoint::take_samples() {
    return std::exchange(samples_, {});
}

void FrameCheckpoint::offer(const std::function<std::string()>& find_samples) {
    if (has_gathers() || !samples_.empty() || !is_due_()) return;
    ByteWriter out;
    out.add_text(identity_);
    out.add(gathers_.size());
    for (const auto& [results, found] : gathers_) {
        out.add_text(results);
        out.add_text(found);
    }
    out.add_text(find_light_ ? find_light_() : std::string());
    out.add_text(find_samples ? find_samples() : std::string());
    std::string text = std::string(magic) + out.take();
    text += hash_bytes(text);
    write_file(file_, text);
}

}  // namespace aleph
