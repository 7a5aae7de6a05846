// The terminal as the person beside a Falcon that is checked: plain lines, and any key lets go of a
// force.
#pragma once

#include <csignal>
#include <optional>
#include <string>

#include <termios.h>

#include "app/window/signals.hpp"
#include "device/falcon/check/guide.hpp"

namespace dibhr {

/// Reads standard input and writes standard output. While it lives, Ctrl+C is a wish to quit, and
/// Ctrl+Z does not stop the program, which could be holding a force. Made before any thread is
/// started. Input that is no terminal answers line by line; of it, only a "q" ends a force.
class TerminalGuide final : public falcon::CheckGuide {
  public:
    TerminalGuide();
    ~TerminalGuide() override;
    TerminalGuide(const TerminalGuide&) = delete;
    TerminalGuide& operator=(const TerminalGuide&) = delete;

    void say(const std::string& text) override;
    void show(const std::string& state) override;
    /// What was typed before a question does not answer it.
    void ask(const std::string& question) override;
    [[nodiscard]] std::optional<std::string> next_line() override;
    [[nodiscard]] bool input_ended() override;
    [[nodiscard]] bool interrupted() override;
    void force_begins() override;
    void force_ended() noexcept override;
    [[nodiscard]] Wish wish() override;

  private:
    void print(const std::string& text);
    void take_input();
    void forget_input() noexcept;

    EndingSignals signals_{};
    sigset_t signals_before_{};
    const bool typed_in_;    // standard input is a terminal
    const bool shown_live_;  // so is standard output
    termios lines_{};        // the terminal as it was found
    std::string input_{};
    bool ended_{false};
    bool interrupted_{false};
    bool live_line_open_{false};
};

}  // namespace dibhr
