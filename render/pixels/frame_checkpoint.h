#pragma once
// The state of a frame that is not finished, in a file, so that another process goes on from there: the results of
// irradiance gathers, of each fill in the order in which they were computed, and the samples of all pixels. What is
// computed quickly is computed again.

#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/base/image.h"

namespace aleph {

/// Plain values as bytes, in the order of the machine.
class ByteWriter {
  public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void add(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void add(const std::vector<T>& values) {
        add(values.size());
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    void add_text(std::string_view text) {
        add(text.size());
        bytes_ += text;
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// Reads what ByteWriter wrote. Bytes that are not enough make is_good() false, and values their defaults.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    T read() {
        T value{};
        const std::string_view found = take(sizeof value);
        if (good_) std::memcpy(static_cast<void*>(&value), found.data(), sizeof value);
        return value;
    }
    template <class T>
    std::vector<T> read_all() {
        const auto count = read<std::size_t>();
        if (count > bytes_.size() / sizeof(T)) good_ = false;
        std::vector<T> values(good_ ? count : 0);
        const std::string_view found = take(values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), found.data(), found.size());
        return values;
    }
    std::string_view read_text() { return take(read<std::size_t>()); }
    bool is_good() const { return good_; }
    bool at_end() const { return bytes_.empty(); }

  private:
    std::string_view take(std::size_t size) {
        good_ = good_ && size <= bytes_.size();
        const std::string_view found = bytes_.substr(0, good_ ? size : 0);
        bytes_.remove_prefix(found.size());
        return found;
    }

    std::string_view bytes_;
    bool good_ = true;
};

/// The bytes of a file of ours: 8 bytes of magic, the content, and SHA-1 of both in 40 hexadecimal digits.
std::string seal(std::string_view magic, std::string_view content);

/// The content of such a file; nothing if it is damaged or not complete.
std::optional<std::string_view> unseal(std::string_view magic, std::string_view file);

class FrameCheckpoint {
  public:
    /// Reads the state that an earlier process left, if the file is whole and of this identity; any other is ignored.
    /// @param is_due    asked between pieces of work: the state is to be written now
    /// @param on_error  told that it could not be written, and the frame goes on; empty: `offer` throws
    FrameCheckpoint(std::filesystem::path file, std::string identity, std::function<bool()> is_due,
                    std::function<void(const OutputError&)> on_error = {});
    FrameCheckpoint(const FrameCheckpoint&) = delete;

    /// Results of some gathers. Gathers of one round do not see what the others found: that is kept apart until the
    /// round has ended, and is then part of the light that gathers share.
    struct Gathers {
        std::string results;
        std::string found;  ///< empty: the round has ended
    };
    /// The gathers from here on belong to this fill of a cache. An earlier process may have done other fills, or in
    /// another order: it had the light of other lighting keyframes.
    /// @param name  empty: that of the frame itself
    void begin_fill(const std::string& name = {});

    /// Returns whether an earlier process computed the next gathers.
    bool has_gathers() const { return next_ < fill_->gathers.size(); }
    const Gathers& next_gathers() { return fill_->gathers.at(next_++); }
    void add_gathers(Gathers gathers);
    /// Drops what the gathers of this round found.
    void end_round();

    /// The light that gathers shared when the earlier process wrote the file: once; empty afterwards.
    std::string take_shared_light() { return std::exchange(fill_->light, {}); }

    /// The samples of the earlier process, once; empty: none.
    std::string take_samples() { return std::exchange(samples_, {}); }

    using FindState = std::function<std::string()>;  ///< called when the file is written

    /// Writes the state if that is due, with what is left of the earlier process. Called after each piece of work.
    /// @param find_samples  may be empty: samples have not begun
    /// @param find_light    the light that gathers share; may be empty: the fill has ended, or shares none
    /// @throws OutputError
    void offer(const FindState& find_samples, const FindState& find_light = {});

  private:
    struct Fill {
        std::vector<Gathers> gathers;
        std::string light;  ///< of take_shared_light
    };

    const std::filesystem::path file_;
    const std::string identity_;
    const std::function<bool()> is_due_;
    const std::function<void(const OutputError&)> on_error_;
    std::map<std::string, Fill> fills_;
    Fill* fill_ = nullptr;
    std::size_t next_ = 0;   ///< of its gathers
    std::size_t round_ = 0;  ///< the first of the present round
    std::string samples_;
};

/// Shows the picture so far while a frame is made; functions may be empty.
struct PartialPicture {
    std::function<bool()> is_wanted;  ///< asked between pieces of work
    std::function<void(const Image<Rgb>& color)> show;
};

}  // namespace aleph
