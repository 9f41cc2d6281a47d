#pragma once
// One change that breaks a rule of a glTF file that loads, and how the file must then be refused.

#include "tests/support/files/gltf_draft.h"
#include "tests/support/test.h"

namespace aleph {

struct BadChange {
    const char* name;
    std::string place;   ///< of the error, exactly
    const char* reason;  ///< a part of the error's
    std::function<void(GltfDraft&)> change;
};

#define BAD(name, place, reason, ...)                          \
    BadChange {                                                \
        name, place, reason, [](GltfDraft& d) { __VA_ARGS__; } \
    }

/// The value where the error must be found: the last argument is assigned there.
#define SET(name, place, reason, ...) BAD(name, place, reason, d.json[Json::json_pointer(place)] = __VA_ARGS__)

inline const std::string material_extension = "/materials/0/extensions/KHR_materials_";

inline std::string bad_name(const testing::TestParamInfo<BadChange>& info) {
    return info.param.name;
}

/// Changes of textured_draft; the test is in bad_input_test.cpp.
class GltfBadJson : public testing::TestWithParam<BadChange> {};

}  // namespace aleph
