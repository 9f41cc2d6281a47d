#include "engine/json/json_ref.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

std::string JsonRef::pointer() const {
    if (parent_ == nullptr) return "";
    if (key_.empty()) return fmt::format("{}/{}", parent_->pointer(), index_);
    return parent_->pointer() + (nlohmann::json::json_pointer() / printable(key_)).to_string();
}

void JsonRef::fail(const std::string& reason) const {
    throw InputError(*file_, pointer(), reason);
}

std::optional<JsonRef> JsonRef::find(std::string_view key) const& {
    expect_object();
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonRef(*member, *this, member.key(), 0);
}

JsonRef JsonRef::require(std::string_view key) const& {
    const std::optional<JsonRef> member = find(key);
    if (!member) fail(fmt::format("\"{}\" is missing", key));
    return *member;
}

JsonRef JsonRef::operator[](std::size_t i) const& {
    return JsonRef((*value_)[i], *this, {}, i);
}

std::vector<JsonRef> JsonRef::elements() const& {
    std::vector<JsonRef> all;
    for (std::size_t i = 0; i < array_size(); ++i) all.push_back((*this)[i]);
    return all;
}

std::size_t JsonRef::array_size(std::size_t min_size) const {
    if (!value_->is_array()) fail(fmt::format("must be an array, found {}", value_->type_name()));
    if (value_->size() < min_size) {
        fail(min_size == 1 ? "the array must not be empty" : fmt::format("the array needs {} elements", min_size));
    }
    return value_->size();
}

const JsonRef& JsonRef::expect_object() const {
    if (!value_->is_object()) fail(fmt::format("must be an object, found {}", value_->type_name()));
    return *this;
}

const std::string& JsonRef::string() const {
    if (!value_->is_string()) fail(fmt::format("must be a string, found {}", value_->type_name()));
    return value_->get_ref<const std::string&>();
}

bool JsonRef::boolean() const {
    if (!value_->is_boolean()) fail(fmt::format("must be true or false, found {}", value_->type_name()));
    return value_->get<bool>();
}

std::int64_t JsonRef::integer(std::int64_t low, std::int64_t high) const {
    if (!value_->is_number_integer()) {
        fail(value_->is_number() ? fmt::format("must be an integer, found {}", value_->get<double>())
                                 : fmt::format("must be an integer, found {}", value_->type_name()));
    }
    // Unsigned values beyond int64 would wrap.
    const bool huge = value_->is_number_unsigned() && value_->get<std::uint64_t>() > std::uint64_t{INT64_MAX};
    if (huge || value_->get<std::int64_t>() < low || value_->get<std::int64_t>() > high) {
        fail(fmt::format("must lie within {} and {}, found {}", low, high, value_->dump()));
    }
    return value_->get<std::int64_t>();
}

double JsonRef::number() const {
    if (!value_->is_number()) fail(fmt::format("must be a number, found {}", value_->type_name()));
    const double number = value_->get<double>();
    if (!std::isfinite(number) || std::abs(number) > max_json_number) {
        fail(fmt::format("must be finite and within +-{}, found {}", max_json_number, number));
    }
    return number;
}

double JsonRef::number_above(double low) const {
    const double value = number();
    if (!(value > low)) fail(fmt::format("must be above {}, found {}", low, value));
    return value;
}

void JsonRef::numbers(std::size_t count) const {
    if (array_size() != count) fail(fmt::format("needs {} numbers, found {}", count, value_->size()));
    for (std::size_t i = 0; i < count; ++i) (*this)[i].number();
}

std::size_t JsonRef::index(std::size_t count, std::string_view kind) const {
    const std::int64_t value = integer(INT64_MIN, INT64_MAX);
    if (value < 0 || static_cast<std::uint64_t>(value) >= count) {
        fail(fmt::format("there is no {} {} (the file has {})", kind, value, count));
    }
    return static_cast<std::size_t>(value);
}

std::optional<std::size_t> JsonRef::find_index(std::string_view key, std::size_t count, std::string_view kind) const {
    const std::optional<JsonRef> member = find(key);
    return member ? std::optional(member->index(count, kind)) : std::nullopt;
}

std::optional<std::int64_t> JsonRef::find_integer(std::string_view key, std::int64_t low, std::int64_t high) const {
    const std::optional<JsonRef> member = find(key);
    return member ? std::optional(member->integer(low, high)) : std::nullopt;
}

std::optional<std::string> JsonRef::find_string(std::string_view key) const {
    const std::optional<JsonRef> member = find(key);
    return member ? std::optional(member->string()) : std::nullopt;
}

void JsonRef::check_number(std::string_view key) const {
    if (const std::optional<JsonRef> member = find(key)) member->number();
}

bool JsonRef::check_numbers(std::string_view key, std::size_t count) const {
    const std::optional<JsonRef> member = find(key);
    if (member) member->numbers(count);
    return member.has_value();
}

void JsonRef::check_boolean(std::string_view key) const {
    if (const std::optional<JsonRef> member = find(key)) member->boolean();
}

std::size_t count_of(const JsonRef& parent, std::string_view key) {
    const std::optional<JsonRef> array = parent.find(key);
    return array ? array->array_size() : 0;
}

}  // namespace aleph
