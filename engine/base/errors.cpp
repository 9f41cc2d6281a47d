#include "engine/base/errors.h"

#include <fmt/format.h>

#include <system_error>
#include <vector>

namespace aleph {

namespace {

std::string join_message(const std::string& file, const std::string& place, const std::string& reason) {
    std::vector<std::string_view> parts{file, place, reason};
    std::erase(parts, "");
    return fmt::format("{}", fmt::join(parts, ": "));
}

}  // namespace

std::string printable(std::string_view text, std::size_t max_bytes) {
    std::string out;
    for (const char c : text.substr(0, max_bytes)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
        } else {
            out += c;
        }
    }
    if (text.size() > max_bytes) out += "...";
    return out;
}

InputError::InputError(std::string file, std::string place, std::string reason)
    : std::runtime_error(join_message(file, place, reason)),
      file_(std::move(file)),
      place_(std::move(place)),
      reason_(std::move(reason)) {}

OutputError::OutputError(const std::string& file, const std::string& reason)
    : std::runtime_error(join_message(file, "", reason)) {}

void fail_output(const std::string& file, const char* what, int error) {  // strerror is not safe between threads
    throw OutputError(printable(file, 4096), fmt::format("{}: {}", what, std::generic_category().message(error)));
}

void fail_check(const char* expression, const char* file, int line, const std::string& values) {
    throw std::logic_error(fmt::format("{}:{}: check failed: {} ({})", file, line, expression, values));
}

}  // namespace aleph
