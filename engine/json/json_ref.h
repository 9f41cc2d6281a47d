#pragma once
// Checked access to parsed JSON: errors name the JSON pointer of the value.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aleph {

/// Largest magnitude of a number in a file.
inline constexpr double max_json_number = 1e18;

/// A value in a document, with its path. It points to its parent, which must outlive it: the deleted overloads refuse
/// temporaries. All functions throw InputError with the JSON pointer of the value that is not as expected.
class JsonRef {
  public:
    JsonRef(const nlohmann::json& root, const std::string& file) : value_(&root), file_(&file) {}

    [[noreturn]] void fail(const std::string& reason) const;
    std::string pointer() const;
    const std::string& file() const { return *file_; }
    const nlohmann::json& json() const { return *value_; }

    /// Member of an object; nothing if it is absent.
    std::optional<JsonRef> find(std::string_view key) const&;
    std::optional<JsonRef> find(std::string_view key) const&& = delete;
    JsonRef require(std::string_view key) const&;
    JsonRef require(std::string_view key) const&& = delete;
    bool has(std::string_view key) const { return expect_object().json().contains(key); }

    /// Element of an array. @param i  below array_size()
    JsonRef operator[](std::size_t i) const&;
    JsonRef operator[](std::size_t i) const&& = delete;
    /// All elements of an array. They point to it.
    std::vector<JsonRef> elements() const&;
    std::vector<JsonRef> elements() const&& = delete;
    /// @param min_size  fewest elements allowed
    std::size_t array_size(std::size_t min_size = 0) const;

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
    /// An index into an array of `count` elements. @param kind  of the elements, for messages
    std::size_t index(std::size_t count, std::string_view kind) const;

    // The same for an optional member.
    std::optional<std::size_t> find_index(std::string_view key, std::size_t count, std::string_view kind) const;
    std::optional<std::int64_t> find_integer(std::string_view key, std::int64_t low, std::int64_t high) const;
    std::optional<std::string> find_string(std::string_view key) const;
    void check_number(std::string_view key) const;
    bool check_numbers(std::string_view key, std::size_t count) const;
    void check_boolean(std::string_view key) const;

  private:
    JsonRef(const nlohmann::json& value, const JsonRef& parent, std::string_view key, std::size_t index)
        : value_(&value), parent_(&parent), key_(key), index_(index), file_(parent.file_) {}

    const nlohmann::json* value_;
    const JsonRef* parent_ = nullptr;
    std::string_view key_;  ///< empty: element `index_` of an array
    std::size_t index_ = 0;
    const std::string* file_;
};

/// Calls visit(element, i) for every element of the array `key`; an absent array has none.
template <class Visit>
void for_each_element(const JsonRef& parent, std::string_view key, const Visit& visit) {
    const std::optional<JsonRef> array = parent.find(key);
    const std::size_t count = array ? array->array_size() : 0;
    for (std::size_t i = 0; i < count; ++i) visit((*array)[i], i);
}
/// The same, where the elements are objects.
template <class Visit>
void for_each_object(const JsonRef& parent, std::string_view key, const Visit& visit) {
    for_each_element(parent, key, [&](const JsonRef& element, std::size_t i) { visit(element.expect_object(), i); });
}

/// Number of elements of an optional array.
std::size_t count_of(const JsonRef& parent, std::string_view key);

}  // namespace aleph
