// Text and numbers as the program writes them: foreign text made safe to show, numbers that read
// back to the same bits, and one-line messages on stderr.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// The text with U+FFFD for control characters, except line breaks and tabs, and for bytes that are
/// no UTF-8.
[[nodiscard]] std::string utf8_text(std::string_view text);

/// As utf8_text, on one line, and cut short where it is longer than `most` letters.
[[nodiscard]] std::string one_line(std::string_view text, std::size_t most = std::string::npos);

/// In quotation marks on one line, cut short after `longest` bytes.
[[nodiscard]] std::string in_quotes(std::string_view text, std::size_t longest = 40);

/// The text with A to Z as a to z.
[[nodiscard]] std::string lower_case(std::string text);

/// The runs of letters and digits of ASCII, in small letters. "Timestamp [ns]" has two.
[[nodiscard]] std::vector<std::string> plain_words_of(std::string_view text);

/// 0 to 9.
[[nodiscard]] bool is_decimal_digit(char c);

/// Whether the text has nothing else; also of an empty one.
[[nodiscard]] bool is_of_digits(std::string_view text);

[[nodiscard]] bool is_one_of(std::string_view word, std::span<const std::string_view> words);

/// The whole text in printable ASCII on one line: other bytes as \x1b, a backslash doubled, and of
/// adjacent blanks all but the first as \x20. Different texts look different.
[[nodiscard]] std::string escaped_text(std::string_view text);

/// "a, b, c".
[[nodiscard]] std::string listed(const std::vector<std::string>& words,
                                 std::string_view between = ", ");

/// Whether the text is a name of letters, digits, "-" and "_" alone; an empty one is none.
[[nodiscard]] bool is_bare_name(std::string_view text);

/// As utf8_text, with HTML's special characters as entities: for an element's text, or an attribute
/// in double quotes.
[[nodiscard]] std::string html_text(std::string_view text);

/// A path as a `file:` address takes it (RFC 3986, section 2.1).
[[nodiscard]] std::string percent_encoded(std::string_view path);

/// The inverse, of any such address. A "%" that is not before two digits stays.
[[nodiscard]] std::string percent_decoded(std::string_view text);

/// Bytes as a `data:` address takes them (RFC 4648, section 4).
[[nodiscard]] std::string base64_text(std::string_view bytes);

/// The inverse, with blanks anywhere in the text. Empty for another text.
[[nodiscard]] std::string bytes_of_base64(std::string text);

/// The shortest text that reads back to the same number.
[[nodiscard]] std::string number_text(double value);

/// With `digits` digits after the point, at most 200.
[[nodiscard]] std::string number_text(double value, int digits);

/// With `digits` significant digits, at most 200, and no zeros at the end: 0.123, 12.3, 1.23e-05.
[[nodiscard]] std::string short_text(double value, int digits = 6);

/// A time from its beginning, "01:23.456".
[[nodiscard]] std::string clock_text(double seconds);

/// The finite number of a text that holds nothing else, in the form above, whatever the locale.
[[nodiscard]] std::optional<double> number_of_text(std::string_view text);

/// Appends with 17 significant digits, as CSV files have it: reads back to the same bits.
void append_number(std::string& text, double value);

/// "dibhr: `message`" on stderr, on one line.
void print_error_line(std::string_view message);

/// "dibhr: warning: `sentence`" on stderr, on one line; nothing for an empty one.
void print_warning(std::string_view sentence);

}  // namespace dibhr
