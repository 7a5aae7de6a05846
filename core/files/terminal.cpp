// Escape sequences of ECMA-48, section 8.3.117 (SGR), where they are understood.
#include "core/files/terminal.hpp"

#include <unistd.h>

#include <cstdlib>

namespace dibhr {

namespace {

constexpr const char* kUsual = "\x1b[0m";

constexpr const char* sequence_of(Paint paint) {
    switch (paint) {
        case Paint::heading:
            return "\x1b[1m";
        case Paint::error:
            return "\x1b[1;31m";
        case Paint::warning:
            return "\x1b[1;33m";
    }
    return kUsual;
}

std::string_view variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view{} : value;
}

}  // namespace

bool shows_colours(int descriptor) {
    const std::string_view terminal = variable("TERM");
    return isatty(descriptor) == 1 && variable("NO_COLOR").empty() && !terminal.empty() &&
           terminal != "dumb";
}

std::string painted(std::string_view text, Paint paint, int descriptor) {
    std::string result(text);
    if (shows_colours(descriptor)) result.insert(0, sequence_of(paint)).append(kUsual);
    return result;
}

}  // namespace dibhr
