#pragma once
// Limits of the memory for loading a file.

#include <cstddef>

namespace aleph {

/// A small text can describe a large scene. Data in binary buffers and Alembic files is limited by the file's size
/// instead.
struct LoadLimits {
    std::size_t memory = std::size_t{512} << 20;  ///< about, at the peak of loading, bytes

    std::size_t text() const { return memory / 8; }              ///< the text itself
    std::size_t json_values() const { return memory / 16 * 5; }  ///< the parsed values
    std::size_t scene() const { return memory / 8 * 3; }         ///< elements made from the values
};

}  // namespace aleph
