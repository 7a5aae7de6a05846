// Escape sequences of ECMA-48, section 8.3.117 (SGR), where they are understood.
#include "core/files/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "core/files/machine.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr const char* kUsual = "\x1b[0m";

constexpr const char* sequence_of(Paint paint) {
    constexpr std::array kSequences{"\x1b[1m", "\x1b[1;31m", "\x1b[1;33m"};
    return kSequences[static_cast<std::size_t>(paint)];
}

bool shows_colours(int descriptor) {
    const std::string_view terminal = environment_variable("TERM");
    return isatty(descriptor) == 1 && environment_variable("NO_COLOR").empty() &&
           !terminal.empty() && terminal != "dumb";
}

}  // namespace

std::string painted(std::string_view text, Paint paint, int descriptor) {
    std::string result(text);
    if (shows_colours(descriptor)) result.insert(0, sequence_of(paint)).append(kUsual);
    return result;
}

PlainOutput::~PlainOutput() {
    stream_.rdbuf(to_);
    static_cast<void>(forward(line_.size()));  // a destructor cannot report a failure
}

std::streambuf::int_type PlainOutput::overflow(int_type letter) {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    const char one = traits_type::to_char_type(letter);
    return xsputn(&one, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize PlainOutput::xsputn(const char* text, std::streamsize count) {
    line_.append(text, static_cast<std::size_t>(count));
    const std::size_t end = line_.rfind('\n');
    return end == std::string::npos || forward(end + 1) ? count : 0;
}

int PlainOutput::sync() {
    return forward(line_.size()) ? to_->pubsync() : -1;
}

bool PlainOutput::forward(std::size_t count) {
    constexpr std::array<std::string_view, 2> kOwn{sequence_of(Paint::heading), kUsual};
    const std::string all = line_.substr(0, count);
    line_.erase(0, count);
    std::string plain;
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t next = std::min(all.find('\x1b', at), all.size());
        plain += utf8_text(std::string_view(all).substr(at, next - at));
        at = next;
        if (at == all.size()) break;
        const auto* const own = std::find_if(kOwn.begin(), kOwn.end(), [&](std::string_view one) {
            return all.compare(at, one.size(), one) == 0;
        });
        const std::size_t length = own == kOwn.end() ? 1 : own->size();
        plain += own == kOwn.end() ? utf8_text(all.substr(at, 1)) : std::string(*own);
        at += length;
    }
    const auto size = static_cast<std::streamsize>(plain.size());
    return to_->sputn(plain.data(), size) == size;
}

}  // namespace dibhr
