#pragma once
// Writes Ogawa archives byte by byte, valid or damaged, from the format's description alone.

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace aleph {

using DraftBytes = std::vector<std::uint8_t>;

template <class T>
DraftBytes bytes_of(const std::vector<T>& values) {
    DraftBytes bytes(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}
inline DraftBytes text_bytes(const std::string& text) {
    DraftBytes bytes(text.begin(), text.end());
    bytes.push_back(0);
    return bytes;
}

struct DraftProperty {
    enum Kind { compound, scalar, array };
    enum Type { boolean = 0, u8 = 1, i8 = 2, u32 = 5, i32 = 6, f32 = 10, f64 = 11, text = 12 };
    std::string name;
    Kind kind = compound;
    Type type = f32;
    std::uint32_t extent = 1;
    std::vector<DraftBytes> samples;  ///< all are stored
    std::uint32_t sampling = 0;
    std::string metadata;
    std::vector<DraftProperty> children;  ///< of a compound
    std::int64_t claimed_samples = -1;    ///< in place of the true number
    std::uint64_t group = 0;              ///< of the draft, in place of one for the samples
};

template <class T>
DraftProperty draft_array(const std::string& name, DraftProperty::Type type, std::uint32_t extent,
                          const std::vector<std::vector<T>>& samples, const std::string& metadata = "") {
    DraftProperty p{name, DraftProperty::array, type, extent, {}, samples.size() > 1 ? 1u : 0u, metadata, {}, -1};
    for (const auto& sample : samples) p.samples.push_back(bytes_of(sample));
    return p;
}
/// A scalar property; every sample has the numbers of one element.
template <class T>
DraftProperty draft_scalar(const std::string& name, DraftProperty::Type type,
                           const std::vector<std::vector<T>>& samples) {
    DraftProperty p = draft_array<T>(name, type, static_cast<std::uint32_t>(samples.front().size()), samples);
    p.kind = DraftProperty::scalar;
    return p;
}
inline DraftProperty draft_text(const std::string& name, const std::string& value) {
    return {name, DraftProperty::scalar, DraftProperty::text, 1, {text_bytes(value)}, 0, "", {}, -1};
}
inline DraftProperty draft_compound(const std::string& name, std::vector<DraftProperty> children) {
    return {name, DraftProperty::compound, DraftProperty::f32, 1, {}, 0, "", std::move(children), -1};
}

struct DraftObject {
    std::string name;
    std::string metadata;
    std::vector<DraftProperty> properties;
    std::vector<DraftObject> children;
};

class OgawaDraft {
  public:
    static constexpr std::uint64_t data_bit = std::uint64_t{1} << 63;
    DraftBytes bytes{'O', 'g', 'a', 'w', 'a', 0xff, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0};
    std::vector<double> times{0.0};  ///< of sampling 1: acyclic, or uniform where it is one
    bool cyclic = false;             ///< `times` come again after every `period`
    double period = 1.0 / 24.0;

    std::uint64_t add_data(const DraftBytes& payload) {
        if (payload.empty()) return data_bit;
        const std::uint64_t offset = bytes.size();
        put(bytes, payload.size(), 8);
        bytes.insert(bytes.end(), payload.begin(), payload.end());
        return offset | data_bit;
    }
    std::uint64_t add_group(const std::vector<std::uint64_t>& children) {
        const std::uint64_t offset = bytes.size();
        put(bytes, children.size(), 8);
        for (const std::uint64_t child : children) put(bytes, child, 8);
        return offset;
    }
    std::uint64_t add_compound(const std::vector<DraftProperty>& properties) {
        if (properties.empty()) return 0;
        std::vector<std::uint64_t> children;
        DraftBytes headers;
        for (const DraftProperty& p : properties) {
            children.push_back(p.group != 0                        ? p.group
                               : p.kind == DraftProperty::compound ? add_compound(p.children)
                                                                   : add_samples(p));
            const std::uint64_t info =
                p.kind | 2u << 2 | static_cast<std::uint32_t>(p.type) << 4 | 0x100u | p.extent << 12 | 255u << 20;
            put(headers, info, 4);
            if (p.kind != DraftProperty::compound) {
                put(headers, p.claimed_samples >= 0 ? static_cast<std::uint64_t>(p.claimed_samples) : p.samples.size(),
                    4);
                put(headers, p.sampling, 4);
            }
            put(headers, p.name.size(), 4);
            headers.insert(headers.end(), p.name.begin(), p.name.end());
            put(headers, p.metadata.size(), 4);
            headers.insert(headers.end(), p.metadata.begin(), p.metadata.end());
        }
        children.push_back(add_data(headers));
        return add_group(children);
    }
    static DraftBytes child_headers(const std::vector<std::pair<std::string, std::string>>& children) {
        DraftBytes headers;
        for (const auto& [name, metadata] : children) {
            put(headers, name.size(), 4);
            headers.insert(headers.end(), name.begin(), name.end());
            put(headers, 255, 1);
            put(headers, metadata.size(), 4);
            headers.insert(headers.end(), metadata.begin(), metadata.end());
        }
        headers.resize(headers.size() + 32);
        return headers;
    }
    std::uint64_t add_object(const DraftObject& object) {
        std::vector<std::uint64_t> children{add_compound(object.properties)};
        std::vector<std::pair<std::string, std::string>> headers;
        for (const DraftObject& child : object.children) {
            children.push_back(add_object(child));
            headers.emplace_back(child.name, child.metadata);
        }
        children.push_back(add_data(child_headers(headers)));
        return add_group(children);
    }
    /// @param root  the root object's group
    const DraftBytes& finish(std::uint64_t root) {
        DraftBytes samplings;
        put(samplings, 1, 4), put_double(samplings, 1.0), put(samplings, 1, 4), put_double(samplings, 0.0);
        put(samplings, 100, 4);
        put_double(samplings, times.size() > 1 && !cyclic ? std::numeric_limits<double>::max() / 32.0 : period);
        put(samplings, times.size(), 4);
        for (const double time : times) put_double(samplings, time);
        const std::uint64_t table = add_data(samplings);
        const std::uint64_t layout = add_data({0, 0, 0, 0}), library = add_data({0x3c, 0x2a, 0, 0});
        const std::uint64_t top = add_group({layout, library, root, data_bit, table, data_bit});
        for (int i = 0; i < 8; ++i) bytes[8 + i] = static_cast<std::uint8_t>(top >> 8 * i);
        return bytes;
    }
    const DraftBytes& finish(const std::vector<DraftObject>& objects) {
        return finish(add_object({"ABC", "", {}, objects}));
    }

    static void put(DraftBytes& to, std::uint64_t value, int width) {
        for (int i = 0; i < width; ++i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    }
    static void put_double(DraftBytes& to, double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, 8);
        put(to, bits, 8);
    }

  private:
    std::uint64_t add_samples(const DraftProperty& p) {
        std::vector<std::uint64_t> children;
        for (const DraftBytes& sample : p.samples) {
            DraftBytes payload(16);  // the digest
            payload.insert(payload.end(), sample.begin(), sample.end());
            const bool empty = p.kind == DraftProperty::array && sample.empty();
            children.push_back(empty ? data_bit : add_data(payload));
            if (p.kind == DraftProperty::array) children.push_back(data_bit);
        }
        return children.empty() ? 0 : add_group(children);
    }
};

inline DraftObject draft_group(const std::string& name, std::vector<DraftObject> children) {
    return {name, "", {}, std::move(children)};
}
inline DraftObject draft_instance(const std::string& name, const std::string& source) {
    return {name, "isInstance=1", {draft_text(".instanceSource", source)}, {}};
}
/// @param more  beside P, .faceCounts and .faceIndices
inline DraftObject draft_mesh(const std::string& name, const std::vector<std::vector<float>>& points,
                              const std::vector<std::vector<int>>& counts, const std::vector<std::vector<int>>& indices,
                              std::vector<DraftProperty> more = {}) {
    more.push_back(draft_array("P", DraftProperty::f32, 3, points));
    more.push_back(draft_array(".faceCounts", DraftProperty::i32, 1, counts));
    more.push_back(draft_array(".faceIndices", DraftProperty::i32, 1, indices));
    return {name, "schema=AbcGeom_PolyMesh_v1", {draft_compound(".geom", std::move(more))}, {}};
}
inline const std::vector<float> draft_points{0, 0, 0, 1, 0, 0, 0, 1, 0};
inline DraftObject draft_triangle(const std::string& name, std::vector<DraftProperty> more = {}) {
    return draft_mesh(name, {draft_points}, {{3}}, {{0, 1, 2}}, std::move(more));
}
inline DraftObject draft_subd(const std::string& name, const std::vector<std::vector<float>>& points,
                              const std::vector<std::vector<int>>& counts, const std::vector<std::vector<int>>& indices,
                              std::vector<DraftProperty> more = {}) {
    DraftObject object = draft_mesh(name, points, counts, indices, std::move(more));
    object.metadata = "schema=AbcGeom_SubD_v1";
    return object;
}

inline std::filesystem::path write_draft(const std::filesystem::path& path, const DraftBytes& bytes) {
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
}

}  // namespace aleph
