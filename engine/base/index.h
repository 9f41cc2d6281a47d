#pragma once

namespace aleph {

/// Of an element of the scene that refers to none.
inline constexpr int no_index = -1;

}  // namespace aleph
