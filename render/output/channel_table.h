#pragma once
// The table of EXR channels: the one place for their meaning, unit, range and background. `aleph maps --help`, the
// attributes of EXR files and render/output/README.md have it; a test compares the latter.

#include <string>
#include <vector>

namespace aleph {

/// Channels that are described together.
struct ChannelInfo {
    std::vector<std::string> names;
    std::string help;                            ///< for --help: a line or two
    std::string content;                         ///< what the values are; whether the exposure factor is in them
    std::string range;                           ///< unit, range and sign
    std::string background = "as for surfaces";  ///< the value where nothing is hit
};

/// All channels that files can have, in the order in which help shows them.
const std::vector<ChannelInfo>& channel_table();

}  // namespace aleph
