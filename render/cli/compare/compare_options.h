#pragma once
// Options of `aleph compare`.

#include <string>

#include "render/compare/compare.h"

namespace aleph {

struct CompareOptions {
    std::string first;       ///< a picture, or the pattern or folder of a sequence
    std::string second;      ///< the reference, of the same kind
    std::string threshold;   ///< maps of the reference, of the same kind; may be empty
    std::string seen;        ///< maps of the reference for visible differences, likewise
    std::string seen_out;    ///< file or pattern of the pictures of visible differences; may be empty
    std::string difference;  ///< file or pattern of the difference pictures; may be empty
    std::string junit;       ///< file of test results; may be empty
    std::string cuts;        ///< list of frames that begin a new shot
    CompareSettings settings;
    bool json = false, quiet = false;
};

}  // namespace aleph
