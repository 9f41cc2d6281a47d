#pragma once
// Reasons why a text is not JSON, in plain words.

#include <string>
#include <string_view>

namespace aleph {

struct SyntaxError {
    std::size_t offset = 0;  ///< of the byte to look at
    std::string reason;
};

/// Recognizes a missing comma and one too many. Other reasons are the parser's.
/// @param position  bytes read when the parser stopped
/// @param token     the bytes of the last token
/// @param what      the message of nlohmann's parser
SyntaxError explain_syntax_error(std::string_view text, std::size_t position, std::string_view token,
                                 const std::string& what);

}  // namespace aleph
