// The person beside a device that is checked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dibhr {

/// The person beside a device that is checked: a terminal, or a test. Used by one thread. No call
/// waits for the person.
class CheckGuide {
  public:
    /// What the person wants while something is measured.
    enum class Wish { none, let_go, quit };

    virtual ~CheckGuide() = default;

    /// Something to read, of one line or more.
    virtual void say(const std::string& text) = 0;
    /// One line about what is going on, in place of the last one.
    virtual void show(const std::string& state) = 0;
    /// A question, whose answer next_line() brings.
    virtual void ask(const std::string& question) = 0;

    /// The next line that was typed, without its end; nothing while there is none.
    [[nodiscard]] virtual std::optional<std::string> next_line() = 0;
    /// Nobody will type any more.
    [[nodiscard]] virtual bool input_ended() = 0;
    /// Ctrl+C, or another request to end.
    [[nodiscard]] virtual bool interrupted() = 0;

    /// Between them a force acts: wish() is asked about every millisecond, and nothing is said,
    /// shown or asked.
    virtual void force_begins() = 0;
    virtual void force_ended() noexcept = 0;
    /// While a force acts, any key lets go at once, and q quits.
    [[nodiscard]] virtual Wish wish() = 0;
};

struct CheckResult {
    std::filesystem::path record{};
    std::string fault{};  ///< why the device failed; empty when it did not
};

}  // namespace dibhr
