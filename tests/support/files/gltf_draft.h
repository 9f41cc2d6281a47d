#pragma once
// Small glTF files made in code: valid scenes that tests then change.

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/gltf/files.h"

namespace aleph {

using Json = nlohmann::json;

inline void write_bytes(const std::filesystem::path& path, const Bytes& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    write_bytes(path, Bytes(text.begin(), text.end()));
}

inline std::string to_base64(const Bytes& bytes) {
    constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// A glTF document with one buffer that grows with each accessor.
struct GltfDraft {
    Json json;
    Bytes buffer;

    /// Appends raw bytes as a buffer view, aligned to 4.
    int add_view(const Bytes& bytes, int stride = 0) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
        if (stride > 0) view["byteStride"] = stride;
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
        json["bufferViews"].push_back(view);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    /// An accessor over values of type C in a view of its own.
    template <class C>
    int add_accessor(const std::vector<C>& values, const char* type, std::size_t components, bool normalized = false) {
        Bytes bytes(values.size() * sizeof(C));
        std::memcpy(bytes.data(), values.data(), bytes.size());
        Json accessor = {{"bufferView", add_view(bytes)},
                         {"componentType", component_type(C{})},
                         {"count", values.size() / components},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    static int component_type(std::int8_t) { return 5120; }
    static int component_type(std::uint8_t) { return 5121; }
    static int component_type(std::int16_t) { return 5122; }
    static int component_type(std::uint16_t) { return 5123; }
    static int component_type(std::uint32_t) { return 5125; }
    static int component_type(float) { return 5126; }

    /// An animation of its own for one property of one node.
    void animate(int node, const char* path, const std::vector<float>& times, const std::vector<float>& values,
                 const char* interpolation = "LINEAR") {
        const std::string name = path;
        const std::size_t components = name == "weights" ? 1 : name == "rotation" ? 4 : 3;
        const int input = add_accessor(times, "SCALAR", 1);
        const int output = add_accessor(values, type_of(components), components);
        json["animations"].push_back(
            {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
    }

    /// A new animation of what a KHR_animation_pointer names.
    void animate_pointer(const char* pointer, const std::vector<float>& times, const std::vector<float>& values,
                         const char* interpolation = "LINEAR") {
        const std::size_t per_key = values.size() / times.size();
        const std::size_t components = std::string(interpolation) == "CUBICSPLINE" ? per_key / 3 : per_key;
        const int input = add_accessor(times, "SCALAR", 1);
        const int output = add_accessor(values, type_of(components), components);
        add_pointer_channel(pointer, input, output, interpolation);
    }
    void add_pointer_channel(const char* pointer, int input, int output, const char* interpolation) {
        json["extensionsUsed"].push_back("KHR_animation_pointer");
        json["animations"].push_back(
            {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels",
              {{{"sampler", 0},
                {"target",
                 {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}}}}});
    }

    static const char* type_of(std::size_t components) {
        constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
        return types[components - 1];
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    void set_length() {
        if (!json.contains("buffers")) json["buffers"] = {{{"byteLength", buffer.size()}}};
    }

    /// The text with the buffer as a data URI.
    std::string to_text() {
        set_length();
        Json whole = json;
        Json& first = whole["buffers"][0];
        if (first.is_object() && !first.contains("uri")) {
            first["uri"] = "data:application/octet-stream;base64," + to_base64(buffer);
        }
        return whole.dump();
    }

    Bytes to_glb() {
        set_length();
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes binary = buffer;
        binary.resize((binary.size() + 3) / 4 * 4);
        Bytes glb;
        const auto put = [&](std::uint32_t value) {
            for (int i = 0; i < 4; ++i) glb.push_back(static_cast<std::uint8_t>(value >> 8 * i));
        };
        put(0x46546c67);
        put(2);
        put(static_cast<std::uint32_t>(28 + text.size() + binary.size()));
        put(static_cast<std::uint32_t>(text.size()));
        put(0x4e4f534a);
        glb.insert(glb.end(), text.begin(), text.end());
        put(static_cast<std::uint32_t>(binary.size()));
        put(0x004e4942);
        glb.insert(glb.end(), binary.begin(), binary.end());
        return glb;
    }
};

/// One triangle under one node. Accessor 0: indices, 1: positions.
inline GltfDraft triangle_draft() {
    GltfDraft draft;
    draft.json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    const int indices = draft.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR", 1);
    const int positions = draft.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    draft.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}}};
    draft.json["nodes"] = {{{"mesh", 0}}};
    return draft;
}

}  // namespace aleph
