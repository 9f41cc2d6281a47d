#include "engine/gltf/write/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/base/errors.h"
#include "engine/base/files.h"

namespace aleph {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's bytes are little-endian");

constexpr int component_u8 = 5121, component_u16 = 5123, component_u32 = 5125, component_f32 = 5126;

void append_u32(std::string& text, std::size_t value) {
    for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> 8 * i & 0xff);
}

void append_chunk(std::string& file, std::string_view kind, std::string_view content, char padding) {
    const std::size_t size = (content.size() + 3) / 4 * 4;
    append_u32(file, size);
    file += kind;
    file += content;
    file.append(size - content.size(), padding);
}

}  // namespace

std::size_t component_count(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "MAT4") return 16;
    return static_cast<std::size_t>(type.back() - '0');
}

int GlbBuffer::add_view(const void* data, std::size_t size, Target target) {
    const std::size_t begin = (bytes_.size() + 3) / 4 * 4;
    if (size > max_file_bytes - begin) {
        throw InputError(
            file_, "",
            fmt::format("the scene takes more than {} bytes as glTF, and larger files are not read", max_file_bytes));
    }
    bytes_.resize(begin);
    bytes_.append(static_cast<const char*>(data), size);
    OrderedJson view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", size}};
    if (target != Target::none) view["target"] = static_cast<int>(target);
    views_.push_back(std::move(view));
    return static_cast<int>(views_.size()) - 1;
}

int GlbBuffer::add_accessor(int view, int component_type, std::size_t count, const char* type) {
    OrderedJson accessor;
    if (view >= 0) accessor["bufferView"] = view;
    accessor["componentType"] = component_type;
    accessor["count"] = count;
    accessor["type"] = type;
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::add_floats(std::span<const float> values, const char* type, Target target, bool with_bounds) {
    const std::size_t components = component_count(type);
    const int accessor = add_accessor(add_view(values.data(), values.size_bytes(), target), component_f32,
                                      values.size() / components, type);
    if (!with_bounds) return accessor;
    // Whole numbers would be written without a fraction, which is the same number.
    std::vector<double> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components)), high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % components] = std::min(low[i % components], double{values[i]});
        high[i % components] = std::max(high[i % components], double{values[i]});
    }
    accessors_.back()["min"] = low;
    accessors_.back()["max"] = high;
    return accessor;
}

int GlbBuffer::add_times(const std::vector<float>& seconds) {
    const auto [known, is_new] = times_.emplace(seconds, 0);
    if (is_new) known->second = add_floats(seconds, "SCALAR", Target::none, true);
    return known->second;
}

int GlbBuffer::add_bytes(std::span<const std::uint8_t> values) {
    return add_accessor(add_view(values.data(), values.size()), component_u8, values.size(), "SCALAR");
}

int GlbBuffer::add_shorts(std::span<const std::uint16_t> values, const char* type, Target target) {
    return add_accessor(add_view(values.data(), values.size_bytes(), target), component_u16,
                        values.size() / component_count(type), type);
}

int GlbBuffer::add_indices(std::span<const std::uint32_t> indices, std::size_t vertices) {
    if (vertices < 0xffff) {  // the largest number starts a strip anew
        const std::vector<std::uint16_t> small(indices.begin(), indices.end());
        return add_shorts(small, "SCALAR", Target::triangles);
    }
    return add_accessor(add_view(indices.data(), indices.size_bytes(), Target::triangles), component_u32,
                        indices.size(), "SCALAR");
}

int GlbBuffer::add_zeros(std::size_t count, const char* type, bool with_bounds) {
    const int accessor = add_accessor(-1, component_f32, count, type);
    if (with_bounds) {
        accessors_.back()["min"] = std::vector<double>(component_count(type), 0.0);
        accessors_.back()["max"] = accessors_.back()["min"];
    }
    return accessor;
}

void GlbBuffer::charge(std::uint64_t bytes, const std::string& place) {
    if (bytes > max_made_bytes - made_bytes_) {
        throw InputError(file_, place,
                         fmt::format("its motion takes more than {} MiB as keys of glTF; shorten the range of frames",
                                     max_made_bytes >> 20));
    }
    made_bytes_ += bytes;
}

std::string GlbBuffer::take_file(OrderedJson document) {
    if (!accessors_.empty()) document["accessors"] = std::move(accessors_);
    if (!views_.empty()) {
        document["bufferViews"] = std::move(views_);
        document["buffers"] = OrderedJson::array({OrderedJson{{"byteLength", bytes_.size()}}});
    }
    // Names of other files need not be UTF-8.
    const std::string json = document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    const bool has_binary = !bytes_.empty();
    const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
    const std::size_t size = 12 + 8 + padded(json.size()) + (has_binary ? 8 + padded(bytes_.size()) : 0);
    if (size > max_file_bytes) throw InputError(file_, "", "the scene is too large for a glTF file");
    std::string file = "glTF";
    file.reserve(size);
    append_u32(file, 2);
    append_u32(file, size);
    append_chunk(file, "JSON", json, ' ');
    if (has_binary) append_chunk(file, std::string_view("BIN\0", 4), bytes_, '\0');
    *this = GlbBuffer(file_);
    return file;
}

}  // namespace aleph
