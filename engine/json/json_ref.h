#pragma once
// Checked reading of raw JSON: every value knows its place, so that an error can name it.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"

namespace aleph {

/// Deepest nesting of arrays and objects in a file; nothing legitimate comes near.
inline constexpr int max_json_depth = 128;
/// Longest JSON text, bytes (embedded base64 included); text.h limits the memory that its values take.
inline constexpr std::size_t max_json_bytes = std::size_t{256} << 20;
/// Largest magnitude of any number that we use.
inline constexpr double max_json_number = 1e18;

/// Parses JSON of an untrusted file. Size and nesting are checked before the parser sees the text, UTF-8 by the parser.
/// @throws InputError
nlohmann::json parse_untrusted_json(std::string_view text, const std::string& file, const LoadLimits& limits);

/// A value inside a document, with the way that led to it. It refers to the value it came from, so that one must
/// outlive it (the deleted overloads see to that). Every mismatch throws InputError with the value's JSON pointer.
class JsonRef {
  public:
    JsonRef(const nlohmann::json& root, const std::string& file) : value_(&root), file_(&file) {}

    [[noreturn]] void fail(const std::string& reason) const;
    std::string pointer() const;
    const std::string& file() const { return *file_; }
    const nlohmann::json& json() const { return *value_; }

    /// Member of an object: nothing where absent.
    std::optional<JsonRef> find(std::string_view key) const&;
    std::optional<JsonRef> find(std::string_view key) const&& = delete;
    JsonRef require(std::string_view key) const&;
    JsonRef require(std::string_view key) const&& = delete;
    bool has(std::string_view key) const { return expect_object().json().contains(key); }

    /// Element of an array whose size was asked before.
    JsonRef operator[](std::size_t i) const&;
    JsonRef operator[](std::size_t i) const&& = delete;
    /// @param least  fewest elements allowed
    std::size_t array_size(std::size_t least = 0) const;

    const JsonRef& expect_object() const;
    const std::string& string() const;
    bool boolean() const;
    /// A JSON integer within [low, high]; 4.0 and "4" are not integers.
    std::int64_t integer(std::int64_t low, std::int64_t high) const;
    /// Finite and within +-max_json_number.
    double number() const;
    double number_above(double low) const;
    /// An array of exactly `count` numbers.
    void numbers(std::size_t count) const;
    /// An index into an array of `count` elements; `kind` is what they are, for the message.
    std::size_t index(std::size_t count, std::string_view kind) const;

    // The same for an optional member, which must be right where it is present.
    std::optional<std::size_t> find_index(std::string_view key, std::size_t count, std::string_view kind) const;
    std::optional<std::int64_t> find_integer(std::string_view key, std::int64_t low, std::int64_t high) const;
    std::optional<std::string> find_string(std::string_view key) const;
    bool check_number(std::string_view key) const;
    bool check_numbers(std::string_view key, std::size_t count) const;
    bool check_boolean(std::string_view key) const;

  private:
    JsonRef(const nlohmann::json& value, const JsonRef& parent, std::string_view key, std::size_t index)
        : value_(&value), parent_(&parent), key_(key), index_(index), file_(parent.file_) {}

    const nlohmann::json* value_;
    const JsonRef* parent_ = nullptr;
    std::string_view key_;  ///< empty: element `index_` of an array
    std::size_t index_ = 0;
    const std::string* file_;
};

/// Calls visit(element, i) for every object of the array `key`; an absent array has none.
template <class Visit>
void for_each_object(const JsonRef& parent, std::string_view key, const Visit& visit) {
    const std::optional<JsonRef> array = parent.find(key);
    const std::size_t count = array ? array->array_size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const JsonRef element = (*array)[i];
        element.expect_object();
        visit(element, i);
    }
}

/// Number of elements of an optional array.
std::size_t count_of(const JsonRef& parent, std::string_view key);

}  // namespace aleph
