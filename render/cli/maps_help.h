#pragma once
// The end of `aleph maps --help`.

#include <string>

namespace aleph {

/// The channels (channel_table), where values of the shot come from, and examples.
std::string maps_footer();

}  // namespace aleph
