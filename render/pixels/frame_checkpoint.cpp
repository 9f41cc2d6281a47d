#include "render/pixels/frame_checkpoint.h"

#include <system_error>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

constexpr std::string_view magic = "alephC3\n";
constexpr std::size_t digest_size = 40;

}  // namespace

std::string seal(std::string_view magic, std::string_view content) {
    const std::string text = std::string(magic).append(content);
    return text + hash_bytes(text);
}

std::optional<std::string_view> unseal(std::string_view magic, std::string_view file) {
    if (!file.starts_with(magic) || file.size() < magic.size() + digest_size) return std::nullopt;
    const std::string_view text = file.substr(0, file.size() - digest_size);
    if (hash_bytes(text) != file.substr(text.size())) return std::nullopt;
    return text.substr(magic.size());
}

FrameCheckpoint::FrameCheckpoint(std::filesystem::path file, std::string identity, std::function<bool()> is_due,
                                 std::function<void(const OutputError&)> on_error)
    : file_(std::move(file)),
      identity_(std::move(identity)),
      is_due_(std::move(is_due)),
      on_error_(std::move(on_error)) {
    begin_fill();
    std::error_code error;
    if (!std::filesystem::exists(file_, error)) return;
    const Bytes bytes = read_regular_file(file_, file_.string(), "");
    const auto content = unseal(magic, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!content) return;
    ByteReader in(*content);
    if (in.read_text() != identity_) return;
    std::map<std::string, Fill> fills;
    for (std::size_t left = in.read<std::size_t>(); left > 0 && in.is_good(); --left) {
        Fill& fill = fills[std::string(in.read_text())];
        fill.light = in.read_text();
        fill.gathers.resize(std::min(in.read<std::size_t>(), content->size()));
        for (auto& [results, found] : fill.gathers) {
            results = in.read_text();
            found = in.read_text();
        }
    }
    const std::string_view samples = in.read_text();
    if (!in.is_good() || !in.at_end()) return;
    fills_ = std::move(fills);
    begin_fill();
    samples_ = samples;
}

void FrameCheckpoint::begin_fill(const std::string& name) {
    fill_ = &fills_[name];
    next_ = round_ = 0;
}

void FrameCheckpoint::add_gathers(Gathers gathers) {
    fill_->gathers.push_back(std::move(gathers));
    next_ = fill_->gathers.size();
}

void FrameCheckpoint::end_round() {
    for (; round_ < next_; ++round_) fill_->gathers[round_].found = {};
}

void FrameCheckpoint::offer(const FindState& find_samples, const FindState& find_light) {
    if (!is_due_()) return;
    ByteWriter out;
    out.add_text(identity_);
    out.add(fills_.size());
    for (const auto& [name, fill] : fills_) {
        out.add_text(name);
        out.add_text(&fill == fill_ && find_light ? find_light() : fill.light);
        out.add(fill.gathers.size());
        for (const auto& [results, found] : fill.gathers) {
            out.add_text(results);
            out.add_text(found);
        }
    }
    out.add_text(find_samples ? find_samples() : samples_);
    try {
        write_file(file_, seal(magic, out.take()));
    } catch (const OutputError& e) {
        if (!on_error_) throw;
        on_error_(e);
    }
}

}  // namespace aleph
