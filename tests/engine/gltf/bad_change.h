#pragma once
// One change that breaks a rule of a glTF file that loads, and how the file must then be refused.

#include "tests/support/files/gltf_draft.h"
#include "tests/support/test.h"

namespace aleph {

struct BadChange {
    const char* name;
    const char* place;   ///< of the error, exactly
    const char* reason;  ///< a part of the error's
    std::function<void(GltfDraft&)> change;
};

#define BAD(name, place, reason, ...)                          \
    BadChange {                                                \
        name, place, reason, [](GltfDraft& d) { __VA_ARGS__; } \
    }

inline std::string bad_name(const testing::TestParamInfo<BadChange>& info) {
    return info.param.name;
}

/// Changes of textured_draft; the test is in bad_input_test.cpp.
class GltfBadJson : public testing::TestWithParam<BadChange> {};

}  // namespace aleph
