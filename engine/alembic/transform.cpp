// Xform objects: operation stacks and whether they inherit.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/alembic/reader.h"
#include "engine/scene/operations.h"

namespace aleph {
namespace {

using Kind = OperationStack::Kind;

constexpr double radians_per_degree = std::numbers::pi / 180.0;

/// The high half of an operation's code is its type, the low half a hint for the package that wrote it.
Kind kind_of(const AlembicReader& reader, int object, int code) {
    constexpr std::array kinds{Kind::scale,    Kind::translate, Kind::rotate,  Kind::matrix,
                               Kind::rotate_x, Kind::rotate_y,  Kind::rotate_z};
    const auto type = static_cast<std::size_t>(code >> 4);
    if (type < kinds.size()) return kinds[type];
    reader.archive.fail(object, fmt::format("its transform has an operation of unknown type {}", code >> 4));
}

/// Takes one sample's channels as our stack wants them: angles in radians, matrices affine.
void convert_channels(const AlembicReader& reader, int object, const OperationStack& stack, double* channels) {
    for (const Kind kind : stack.operations) {
        const std::size_t count = channel_count(kind);
        for (std::size_t i = 0; i < count; ++i) {
            if (!std::isfinite(channels[i]))
                reader.archive.fail(object, fmt::format("its transform holds {}", channels[i]));
        }
        const bool angle_only = kind == Kind::rotate_x || kind == Kind::rotate_y || kind == Kind::rotate_z;
        if (angle_only || kind == Kind::rotate) channels[count - 1] *= radians_per_degree;
        if (kind == Kind::matrix) {  // row by row for row vectors: column by column for column vectors
            const bool nearly =
                std::abs(channels[3]) + std::abs(channels[7]) + std::abs(channels[11]) + std::abs(channels[15] - 1.0) <=
                1e-6;
            if (!nearly) reader.archive.fail(object, "its matrix is not affine: the last column must be 0 0 0 1");
            channels[3] = channels[7] = channels[11] = 0.0;
            channels[15] = 1.0;
        }
        channels += count;
    }
}

void append_defaults(OperationStack& stack) {
    for (const Kind kind : stack.operations) {
        const std::size_t count = channel_count(kind);
        for (std::size_t i = 0; i < count; ++i) {
            const bool one = kind == Kind::scale || (kind == Kind::matrix && i % 5 == 0);
            stack.channels.push_back(one ? 1.0 : 0.0);
        }
    }
}

}  // namespace

void read_transform(AlembicReader& reader, int object, const AlembicCompound& top, Node& node) {
    const AlembicArchive& archive = reader.archive;
    const AlembicCompound xform = archive.properties(top, ".xform");
    if (const AlembicProperty* inherits = xform.find_sampled(".inherits")) {
        node.inherits = read_whole_track(reader, *inherits, Interpolation::step, [](int v) { return v ? 1.0 : 0.0; });
        node.inherits.sampling.start -= same_time;
        for (double& time : node.inherits.sampling.times) time -= same_time;
    }
    const AlembicProperty* operations = xform.find_sampled(".ops");
    if (operations == nullptr) return;

    OperationStack stack;
    for (const int code : archive.numbers<int>(*operations, 0))
        stack.operations.push_back(kind_of(reader, object, code));
    const std::size_t count = channel_count(stack);
    if (count == 0) return;
    const AlembicProperty* channels = xform.find_sampled(".vals");
    if (channels == nullptr) {
        append_defaults(stack);
    } else {
        const AlembicSamples samples = archive.samples(*channels);
        stack.sampling = samples.sampling;
        for (const std::uint64_t index : samples.indices) {
            std::vector<double> values = archive.numbers<double>(*channels, index);
            if (values.size() != count) {
                archive.fail(
                    object, fmt::format("its transform has {} channels, its operations take {}", values.size(), count));
            }
            convert_channels(reader, object, stack, values.data());
            stack.channels.insert(stack.channels.end(), values.begin(), values.end());
        }
        reader.widen(*channels);
    }
    node.transform.operations = std::move(stack);
}

}  // namespace aleph
