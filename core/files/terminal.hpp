// Colours for who reads at a terminal, and nothing else that a terminal obeys.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace dibhr {

enum class Paint { heading, error, warning };

/// For that descriptor; where it shows no colours, or NO_COLOR is set (no-color.org: to any value
/// but an empty one), the text as it is.
[[nodiscard]] std::string painted(std::string_view text, Paint paint, int descriptor);

/// While it lives, all that goes into the stream has lost its control characters, but line breaks,
/// tabs and painted() headings: texts of files, devices and services mean nothing to a terminal.
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
    [[nodiscard]] bool give(std::size_t count);

    std::ostream& stream_;
    std::streambuf* to_;
    std::string line_{};  ///< that has no end yet
};

}  // namespace dibhr
