// Lines in, lines out, and single keys while a force acts.
#include "app/commands/terminal_console.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "app/window/signals.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kLineLength = 79;  // of printed text, in characters

/// Breaks long lines at spaces.
std::string wrapped(const std::string& text) {
    std::string result;
    std::size_t column = 0;
    std::size_t space = std::string::npos;  // the last one of this line
    for (const char c : text) {
        if (c == '\n') {
            column = 0;
            space = std::string::npos;
            result += c;
            continue;
        }
        if (c == ' ') space = result.size();
        result += c;
        if (++column <= kLineLength || space == std::string::npos) continue;
        result[space] = '\n';
        column = result.size() - space - 1;
        space = std::string::npos;
    }
    return result;
}

class TerminalConsole final : public CheckConsole {
  public:
    TerminalConsole()
        : input_is_terminal_(isatty(STDIN_FILENO) == 1),
          output_is_terminal_(isatty(STDOUT_FILENO) == 1) {
        // A stopped program sends neither a force nor zero: the motors might keep the last force.
        sigset_t stopping;
        sigemptyset(&stopping);
        for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) sigaddset(&stopping, signal);
        pthread_sigmask(SIG_BLOCK, &stopping, &signals_before_);
        if (input_is_terminal_) tcgetattr(STDIN_FILENO, &saved_terminal_);
    }

    ~TerminalConsole() override { pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr); }

    TerminalConsole(const TerminalConsole&) = delete;
    TerminalConsole& operator=(const TerminalConsole&) = delete;

    void print(const std::string& text) override { write_out(wrapped(text) + "\n"); }

    void show(const std::string& state) override {
        if (!output_is_terminal_) return;
        std::cout.flush();
        // Not through std::cout, which removes control characters: this overwrites the line.
        const std::string line = '\r' + one_line(state) + "\x1b[K";
        live_line_open_ = ::write(STDOUT_FILENO, line.data(), line.size()) > 0;
    }

    /// Discards what was typed before the question.
    void ask(const std::string& question) override {
        if (input_is_terminal_) discard_input();
        write_out(wrapped(question) + "\n> ");
    }

    [[nodiscard]] std::optional<std::string> next_line() override {
        read_input();
        const std::size_t end = input_.find('\n');
        if (end == std::string::npos && (!ended_ || input_.empty())) return std::nullopt;
        std::string line = input_.substr(0, end);
        input_.erase(0, end == std::string::npos ? end : end + 1);
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos) return "";
        return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
    }

    [[nodiscard]] bool input_ended() override { return ended_ && input_.empty(); }

    [[nodiscard]] bool interrupted() override {
        interrupted_ = interrupted_ || signals_.arrived();
        return interrupted_;
    }

    void force_begins() override {
        write_out("FORCE\n");
        if (!input_is_terminal_) return;
        discard_input();
        termios keys = saved_terminal_;
        keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        // Ctrl+Z and Ctrl+\ are keys like any other: they must not stop or kill the program now.
        keys.c_cc[VSUSP] = keys.c_cc[VQUIT] = _POSIX_VDISABLE;
        tcsetattr(STDIN_FILENO, TCSANOW, &keys);
    }

    void force_ended() noexcept override {
        if (!input_is_terminal_) return;
        tcsetattr(STDIN_FILENO, TCSANOW, &saved_terminal_);
        discard_input();
    }

    [[nodiscard]] Request request() override {
        if (interrupted()) return Request::quit;
        read_input();
        if (input_is_terminal_) {
            // Key input ends only with the terminal, which may be read before the signal arrives.
            if (ended_ || input_.find('q') != std::string::npos) return Request::quit;
            return input_.empty() ? Request::none : Request::release;
        }
        // Further input of a pipe may be the answer to the next question.
        return input_ == "q" || input_.starts_with("q\n") ? Request::quit : Request::none;
    }

  private:
    void write_out(const std::string& text) {
        if (std::exchange(live_line_open_, false)) std::cout << '\n';
        std::cout << text << std::flush;
    }

    void read_input() {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (ended_ || poll(&input, 1, 0) <= 0) return;
        std::array<char, 256> bytes{};
        const ssize_t got = read(STDIN_FILENO, bytes.data(), bytes.size());
        if (got > 0) input_.append(bytes.data(), static_cast<std::size_t>(got));
        if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) ended_ = true;
    }

    void discard_input() noexcept {
        input_.clear();
        tcflush(STDIN_FILENO, TCIFLUSH);
    }

    ShutdownSignals signals_{};
    sigset_t signals_before_{};
    const bool input_is_terminal_;   // standard input is a terminal
    const bool output_is_terminal_;  // standard output is one, too
    termios saved_terminal_{};       // the terminal as it was found
    std::string input_{};
    bool ended_{false};
    bool interrupted_{false};
    bool live_line_open_{false};
};

}  // namespace

std::unique_ptr<CheckConsole> make_terminal_console() {
    return std::make_unique<TerminalConsole>();
}

}  // namespace dibhr
