// Writes one line on stderr.
#include "core/files/error_line.hpp"

#include <algorithm>
#include <iostream>
#include <string>

#include "core/files/plain_text.hpp"

namespace dibhr {

std::string one_line(std::string_view text) {
    std::string line = utf8_text(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return line;
}

void print_error_line(std::string_view message) {
    while (!message.empty() && message.back() == '\n') message.remove_suffix(1);
    std::cerr << "dibhr: " << one_line(message) << '\n';
}

void print_warning(std::string_view sentence) {
    if (!sentence.empty()) print_error_line("warning: " + std::string(sentence));
}

}  // namespace dibhr
