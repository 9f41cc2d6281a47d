#pragma once
// Fields of JSON.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace aleph {

/// Expects an object to have these fields, however deep; it may have others. Lists are equal as a whole.
template <class Json>
void expect_fields(const Json& json, const char* fields) {
    Json with_fields = json;
    with_fields.merge_patch(Json::parse(fields));
    EXPECT_EQ(Json::diff(json, with_fields).dump(), "[]") << "changes that would give it the fields";
}

}  // namespace aleph
