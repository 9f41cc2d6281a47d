#pragma once
// Which frames are copies of others, in words.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace aleph {

struct FinishedFrame {
    std::int64_t frame = 0;
    std::optional<std::int64_t> copy_of;
};

/// Lines such as "aleph: frames 12-30 are copies of frame 11: nothing changes", one for every frame that others copy,
/// in the order of `frames`; a last line counts those beyond the fourth. Empty if no frame is a copy.
std::string describe_copies(const std::vector<FinishedFrame>& frames);

}  // namespace aleph
