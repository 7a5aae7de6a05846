// Text that people or files gave, made safe to show: in a page, in JSON, on a picture.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dibhr {

/// Without control characters but line breaks and tabs, and with U+FFFD for bytes that are no
/// UTF-8.
[[nodiscard]] std::string utf8_text(std::string_view text);

/// On one line, with '?' for every letter the plots cannot write, and cut short where it is longer
/// than `most` letters.
[[nodiscard]] std::string ascii_text(std::string_view text, std::size_t most);

/// As utf8_text, and means nothing to a browser: for the text of an element or an attribute in
/// double quotes.
[[nodiscard]] std::string html_text(std::string_view text);

/// Bytes as a `data:` address takes them (RFC 4648, section 4).
[[nodiscard]] std::string base64_text(std::string_view bytes);

}  // namespace dibhr
