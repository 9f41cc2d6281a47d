#include "engine/scene/operations.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/scene/components.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;
using Kind = OperationStack::Kind;

/// In the order of OperationStack::Kind.
constexpr std::array operation_words{"translate", "scale", "matrix", "rotate", "rotate_x", "rotate_y", "rotate_z"};
/// Rotations by angles without exact degrees.
constexpr std::array radian_words{"rotate_x_radians", "rotate_y_radians", "rotate_z_radians"};

/// Collects channels: constants, and tracks that share one sampling.
class Stack {
  public:
    void add_kind(Kind kind) { stack_.operations.push_back(kind); }

    template <class T>
    void add(const Track<T>& track, const JsonRef& at) {
        if (track.interpolation != Interpolation::linear) at.fail("operations are linear between their keys");
        const bool keyed = track.values.size() > 1 || track.sampling != TimeSampling{};
        if (keyed && samples_ > 0 && (track.sampling != stack_.sampling || track.values.size() != samples_)) {
            at.fail("the keyed operations of a node have the same times: give this one keys where the first has them");
        }
        if (keyed && samples_ == 0) {
            stack_.sampling = track.sampling;
            samples_ = track.values.size();
        }
        auto& values = tracks_.emplace_back();
        for (const T& value : track.values) values.emplace_back(components(value).begin(), components(value).end());
    }

    OperationStack take() {
        for (std::size_t sample = 0; sample < std::max<std::size_t>(samples_, tracks_.empty() ? 0 : 1); ++sample) {
            for (const auto& values : tracks_) {
                const auto& value = values[std::min(sample, values.size() - 1)];
                stack_.channels.insert(stack_.channels.end(), value.begin(), value.end());
            }
        }
        return std::move(stack_);
    }

  private:
    OperationStack stack_;
    std::size_t samples_ = 0;  ///< 0: nothing is keyed so far
    std::vector<std::vector<std::vector<double>>> tracks_;
};

void read_turn(Stack& stack, const JsonRef& at, const FrameRate& rate) {
    const JsonRef axis = at.require("axis");
    stack.add(read_vector(axis, rate, any_value), axis);
    const auto degrees = at.find("degrees"), radians = at.find("radians");
    if (degrees.has_value() == radians.has_value()) at.fail("an axis goes with either \"degrees\" or \"radians\"");
    if (degrees) stack.add(read_degrees(*degrees, rate, any_value), *degrees);
    if (radians) stack.add(read_number(*radians, rate, any_value), *radians);
}

void read_operation(Stack& stack, const JsonRef& at, const FrameRate& rate) {
    if (at.json().size() != 1) {
        at.fail(fmt::format("an operation is an object with one key, found {}: write one object for each",
                            at.json().size()));
    }
    const std::string key = at.json().begin().key();
    const JsonRef value = at.require(key);
    for (std::size_t i = 0; i < radian_words.size(); ++i) {
        if (key != radian_words[i]) continue;
        stack.add_kind(static_cast<Kind>(index_of(Kind::rotate_x) + i));
        stack.add(read_number(value, rate, any_value), value);
        return;
    }
    const auto word = std::find(operation_words.begin(), operation_words.end(), key);
    const auto kind = static_cast<Kind>(word - operation_words.begin());
    stack.add_kind(kind);
    switch (kind) {
        case Kind::translate:
            stack.add(read_vector(value, rate, any_value), value);
            break;
        case Kind::scale:
            stack.add(read_scale(value, rate), value);
            break;
        case Kind::matrix:
            stack.add(read_matrix(value, rate), value);
            break;
        case Kind::rotate:
            read_turn(stack, value, rate);
            break;
        default:
            stack.add(read_degrees(value, rate, any_value), value);
    }
}

/// Some channels of a stack as a track, for the writers of tracks.
class Channels {
  public:
    Channels(const OperationStack& stack, bool keep_keys) : stack_(stack), keep_keys_(keep_keys) {}

    template <class T>
    Track<T> take() {
        const std::size_t samples = sample_count(stack_), width = channel_count(stack_);
        Track<T> track;
        track.values.resize(samples);
        for (std::size_t sample = 0; sample < samples; ++sample) {
            const auto value = components(track.values[sample]);
            std::copy_n(&stack_.channels[sample * width + at_], value.size(), value.begin());
        }
        at_ += sizeof(T) / sizeof(double);
        const auto same = [&](const T& value) { return value == track.values.front(); };
        const bool keyed =
            std::exchange(keep_keys_, false) || !std::all_of(track.values.begin(), track.values.end(), same);
        if (!keyed) return Track<T>(track.values.front());
        track.sampling = stack_.sampling;
        return track;
    }

  private:
    const OperationStack& stack_;
    bool keep_keys_;
    std::size_t at_ = 0;
};

ordered_json write_operation(Kind kind, Channels& channels, const FrameRate& rate) {
    const char* word = operation_words[index_of(kind)];
    switch (kind) {
        case Kind::translate:
            return {{word, write_vector(channels.take<glm::dvec3>(), rate)}};
        case Kind::scale:
            return {{word, write_scale(channels.take<glm::dvec3>(), rate)}};
        case Kind::matrix:
            return {{word, write_matrix(channels.take<glm::dmat4>(), rate)}};
        case Kind::rotate: {
            ordered_json turn = {{"axis", write_vector(channels.take<glm::dvec3>(), rate)}};
            const Track<double> angle = channels.take<double>();
            const auto degrees = write_degrees(angle, rate);
            turn[degrees ? "degrees" : "radians"] = degrees ? *degrees : write_number(angle, rate);
            return {{word, turn}};
        }
        default: {
            const Track<double> angle = channels.take<double>();
            if (const auto degrees = write_degrees(angle, rate)) return {{word, *degrees}};
            const std::size_t axis = index_of(kind) - index_of(Kind::rotate_x);
            return {{radian_words[axis], write_number(angle, rate)}};
        }
    }
}

}  // namespace

OperationStack read_operations(const JsonRef& at, const FrameRate& rate) {
    Stack stack;
    for (const JsonRef operation : at.elements()) read_operation(stack, operation, rate);
    return stack.take();
}

ordered_json write_operations(const OperationStack& stack, const FrameRate& rate, const std::string& file,
                              const std::string& place) {
    ordered_json out = ordered_json::array();
    const std::size_t width = channel_count(stack);
    if (width == 0) return out;
    if (stack.channels.empty() || stack.channels.size() % width != 0) {
        throw InputError(file, place,
                         fmt::format("its operations have {} channels, found {}", width, stack.channels.size()));
    }
    validate(stack.sampling, sample_count(stack), file, place);
    // If no value changes, the first operation keeps the keys.
    Channels probe(stack, false);
    bool keyed = false;
    for (std::size_t i = 0; i < width; ++i) keyed = probe.take<double>().values.size() > 1 || keyed;
    const bool keep_keys = !keyed && (sample_count(stack) > 1 || stack.sampling != TimeSampling{});
    Channels channels(stack, keep_keys);
    for (const Kind kind : stack.operations) out.push_back(write_operation(kind, channels, rate));
    return out;
}

}  // namespace aleph
