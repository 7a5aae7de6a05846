// Colours on a terminal, and output without any other control sequence.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace dibhr {

enum class Paint { heading, error, warning };

/// The text with colour for that descriptor; unchanged where it shows no colours, or NO_COLOR is
/// set (no-color.org: to any value but an empty one).
[[nodiscard]] std::string painted(std::string_view text, Paint paint, int descriptor);

/// While it exists, removes control characters from all output of the stream, except line breaks,
/// tabs and painted() headings: texts of files, devices and services cannot control the terminal.
class PlainOutput : private std::streambuf {
  public:
    explicit PlainOutput(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}
    ~PlainOutput() override;
    PlainOutput(const PlainOutput&) = delete;
    PlainOutput& operator=(const PlainOutput&) = delete;

  private:
    int_type overflow(int_type letter) override;
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int sync() override;
    [[nodiscard]] bool forward(std::size_t count);

    std::ostream& stream_;
    std::streambuf* to_;
    std::string line_{};  ///< the line that is not complete yet
};

}  // namespace dibhr
