#pragma once
// How much memory a text may ask for.

#include <cstddef>

namespace aleph {

/// So that a small text cannot ask for all memory (HARD_CASES section 13, rule 11). The data beside a text, in buffers
/// and archives, is limited by its own size instead.
struct LoadLimits {
    std::size_t memory = std::size_t{512} << 20;  ///< at the peak of loading, bytes, about

    std::size_t text() const { return memory / 8; }              ///< the text itself
    std::size_t json_values() const { return memory / 16 * 5; }  ///< the values that it parses to
    std::size_t scene() const { return memory / 8 * 3; }         ///< what is made of them
};

}  // namespace aleph
