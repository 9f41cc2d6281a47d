#pragma once
// glTF files as tinygltf parses them, and the poses that glTF 2.0 gives them, without the engine.

#include <tiny_gltf.h>

#include "tests/support/test.h"

namespace aleph {

namespace fs = std::filesystem;
namespace gltf = tinygltf;

/// Images are not needed.
inline bool skip_image(gltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                       void*) {
    return true;
}

/// A file as tinygltf reads it.
struct Raw {
    explicit Raw(const fs::path& file) {
        gltf::TinyGLTF parser;
        parser.SetImageLoader(skip_image, nullptr);
        std::string error, warning;
        const std::string path = file.string();
        const bool read = file.extension() == ".glb" ? parser.LoadBinaryFromFile(&model, &error, &warning, path)
                                                     : parser.LoadASCIIFromFile(&model, &error, &warning, path);
        EXPECT_TRUE(read) << error;
    }
    /// Float values of a packed or sparse accessor.
    std::vector<double> floats(int index) const {
        const gltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
        const auto components =
            static_cast<std::size_t>(gltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
        EXPECT_EQ(accessor.componentType, TINYGLTF_COMPONENT_TYPE_FLOAT);
        std::vector<float> values(accessor.count * components);
        if (accessor.bufferView >= 0) copy(accessor.bufferView, accessor.byteOffset, values);
        if (accessor.sparse.isSparse) {
            const auto& indices = accessor.sparse.indices;
            const auto& replaced = accessor.sparse.values;
            const auto count = static_cast<std::size_t>(accessor.sparse.count);
            std::vector<float> rows(count * components);
            copy(replaced.bufferView, replaced.byteOffset, rows);
            const int width = gltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indices.componentType));
            std::vector<std::uint8_t> places(count * static_cast<std::size_t>(width));
            copy(indices.bufferView, indices.byteOffset, places);
            for (std::size_t i = 0; i < count; ++i) {
                std::size_t place = 0;
                std::memcpy(&place, &places[i * static_cast<std::size_t>(width)], static_cast<std::size_t>(width));
                for (std::size_t k = 0; k < components; ++k)
                    values.at(place * components + k) = rows[i * components + k];
            }
        }
        return {values.begin(), values.end()};
    }
    template <class T>
    void copy(int view_number, std::size_t offset, std::vector<T>& values) const {
        const gltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(view_number));
        const auto& buffer = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
        ASSERT_LE(view.byteOffset + offset + values.size() * sizeof(T), buffer.size());
        std::memcpy(values.data(), buffer.data() + view.byteOffset + offset, values.size() * sizeof(T));
    }
    gltf::Model model;
};

/// A channel worked out from glTF 2.0, appendix C, without the engine.
struct Keys {
    std::vector<double> times, values;
    std::size_t row = 1;
    std::string interpolation;

    Keys(const Raw& raw, const gltf::Animation& animation, const gltf::AnimationChannel& channel, std::size_t width)
        : times(raw.floats(animation.samplers[channel.sampler].input)),
          values(raw.floats(animation.samplers[channel.sampler].output)),
          row(width),
          interpolation(animation.samplers[channel.sampler].interpolation) {}

    std::vector<double> value(std::size_t key, std::size_t part = 1) const {
        const std::size_t first = (interpolation == "CUBICSPLINE" ? 3 * key + part : key) * row;
        return {values.begin() + static_cast<std::ptrdiff_t>(first),
                values.begin() + static_cast<std::ptrdiff_t>(first + row)};
    }
    std::vector<double> at(double t) const {
        if (t <= times.front()) return value(0);
        if (t >= times.back()) return value(times.size() - 1);
        std::size_t k = 0;
        while (times[k + 1] <= t) ++k;
        const double interval = times[k + 1] - times[k], s = (t - times[k]) / interval;
        const std::vector<double> a = value(k), b = value(k + 1);
        std::vector<double> result = a;
        if (interpolation == "STEP") return a;
        if (interpolation == "CUBICSPLINE") {
            const std::vector<double> leaving = value(k, 2), arriving = value(k + 1, 0);
            for (std::size_t i = 0; i < row; ++i) {
                result[i] = (2 * s * s * s - 3 * s * s + 1) * a[i] +
                            interval * (s * s * s - 2 * s * s + s) * leaving[i] + (-2 * s * s * s + 3 * s * s) * b[i] +
                            interval * (s * s * s - s * s) * arriving[i];
            }
            return row == 4 ? unit(result) : result;
        }
        if (row == 4) return slerp(a, b, s);
        for (std::size_t i = 0; i < row; ++i) result[i] = a[i] + s * (b[i] - a[i]);
        return result;
    }
    static std::vector<double> unit(std::vector<double> q) {
        double length = 0.0;
        for (const double c : q) length += c * c;
        for (double& c : q) c /= std::sqrt(length);
        return q;
    }
    static std::vector<double> slerp(std::vector<double> a, std::vector<double> b, double s) {
        a = unit(a);
        b = unit(b);
        double dot = 0.0;
        for (std::size_t i = 0; i < 4; ++i) dot += a[i] * b[i];
        for (double& c : b) c *= dot < 0.0 ? -1.0 : 1.0;
        double across = 0.0;  // acos of a number near 1 would lose half the digits
        for (std::size_t i = 0; i < 4; ++i) across += std::pow(b[i] - std::abs(dot) * a[i], 2);
        const double angle = std::atan2(std::sqrt(across), std::abs(dot));
        if (angle < 1e-12) return a;
        for (std::size_t i = 0; i < 4; ++i) {
            a[i] = (a[i] * std::sin((1 - s) * angle) + b[i] * std::sin(s * angle)) / std::sin(angle);
        }
        return a;
    }
};

inline glm::dmat4 local_matrix(const std::vector<double>& t, const std::vector<double>& r,
                               const std::vector<double>& s) {
    const glm::dmat3 turn = glm::mat3_cast(glm::dquat(r[3], r[0], r[1], r[2]));
    return {glm::dvec4(turn[0] * s[0], 0.0), glm::dvec4(turn[1] * s[1], 0.0), glm::dvec4(turn[2] * s[2], 0.0),
            glm::dvec4(t[0], t[1], t[2], 1.0)};
}

/// World matrices of all nodes at a time; of animations on one property the first counts.
inline std::vector<glm::dmat4> world_matrices(const Raw& raw, double seconds) {
    const gltf::Model& model = raw.model;
    std::vector<glm::dmat4> local, world(model.nodes.size(), glm::dmat4(1.0));
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const gltf::Node& node = model.nodes[i];
        for (const int child : node.children) parents[child] = static_cast<int>(i);
        std::vector<double> t{0, 0, 0}, r{0, 0, 0, 1}, s{1, 1, 1};
        if (!node.translation.empty()) t = node.translation;
        if (!node.rotation.empty()) r = Keys::unit(node.rotation);
        if (!node.scale.empty()) s = node.scale;
        for (auto animation = model.animations.rbegin(); animation != model.animations.rend(); ++animation) {
            for (const gltf::AnimationChannel& channel : animation->channels) {
                if (channel.target_node != static_cast<int>(i)) continue;
                if (channel.target_path == "translation") t = Keys(raw, *animation, channel, 3).at(seconds);
                if (channel.target_path == "scale") s = Keys(raw, *animation, channel, 3).at(seconds);
                if (channel.target_path == "rotation") r = Keys::unit(Keys(raw, *animation, channel, 4).at(seconds));
            }
        }
        glm::dmat4 matrix = local_matrix(t, r, s);
        for (std::size_t k = 0; k < node.matrix.size(); ++k) {
            matrix[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = node.matrix[k];
        }
        local.push_back(matrix);
    }
    for (std::size_t i = 0; i < local.size(); ++i) {
        world[i] = local[i];
        for (int p = parents[i]; p >= 0; p = parents[p]) {
            world[i] = local[p] * world[i];
        }
    }
    return world;
}

}  // namespace aleph
