#pragma once
// Frames per second as an exact fraction, so that 30000/1001 has no rounding.

#include <cstdint>

namespace aleph {

/// Frames lie within this of 0: their numbers are exact in double, and differences of them do not overflow.
inline constexpr std::int64_t farthest_frame = 9'000'000'000'000'000;

inline bool is_frame(std::int64_t frame) {
    return frame >= -farthest_frame && frame <= farthest_frame;
}

struct FrameRate {
    std::int64_t numerator = 30;  ///< frames per `denominator` seconds
    std::int64_t denominator = 1;

    double per_second() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
    /// Time of a frame, s. Computed from the frame number alone: times that are added up frame by frame drift.
    double seconds_of(std::int64_t frame) const {
        return static_cast<double>(frame) * static_cast<double>(denominator) / static_cast<double>(numerator);
    }
    bool operator==(const FrameRate&) const = default;
};

}  // namespace aleph
