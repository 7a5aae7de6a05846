// Input and output of a device check.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// Input and output of a device check: a terminal, or a test in its place. Used by one thread. No
/// call waits for the user.
class CheckConsole {
  public:
    /// What the user requests while a force acts.
    enum class Request { none, release, quit };

    virtual ~CheckConsole() = default;

    /// Prints a text of one line or more.
    virtual void print(const std::string& text) = 0;
    /// Shows one line of live state, in place of the last one.
    virtual void show(const std::string& state) = 0;
    /// Prints a question; next_line() returns the answer.
    virtual void ask(const std::string& question) = 0;

    /// The next typed line, without its newline; nothing while there is none.
    [[nodiscard]] virtual std::optional<std::string> next_line() = 0;
    /// The input has ended: no line will come any more.
    [[nodiscard]] virtual bool input_ended() = 0;
    /// Ctrl+C, or another request to end.
    [[nodiscard]] virtual bool interrupted() = 0;

    /// A force acts between these two calls. Meanwhile the check polls the requests about every
    /// millisecond, and prints nothing.
    virtual void force_begins() = 0;
    virtual void force_ended() noexcept = 0;
    /// While a force acts, any key ends it at once, and q quits.
    [[nodiscard]] virtual Request request() = 0;
};

struct CheckResult {
    std::filesystem::path record{};
    std::string fault{};  ///< why the device failed; empty when it did not
};

}  // namespace dibhr
