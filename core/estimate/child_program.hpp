// Another program, started by a keeper (keeper/depth_keeper.cpp) that ends it with all it started.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace dibhr {

/// How a program ended.
struct ChildEnd {
    int exit_code{0};
    int signal{0};  ///< that killed it; 0: it ended by itself

    [[nodiscard]] bool well() const noexcept { return exit_code == 0 && signal == 0; }
};

/// "ended with 1", "was ended by signal 11 (Segmentation fault)"
[[nodiscard]] std::string in_words(const ChildEnd& end);

/// How much it gives way to others.
enum class ChildManner { ordinary, polite };

/// From here on that process, or thread, and what it starts give way to others; 0: the thread that
/// calls.
void give_way(pid_t who) noexcept;

class ChildProgram {
  public:
    /// Starts it, without a shell and without a keyboard. Throws InputError when that cannot be:
    /// what, and what to do next. However this program ends, it is killed then, with all that it
    /// started.
    ChildProgram(std::vector<std::string> words, ChildManner manner);
    /// Kills what is left of it.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// What it has written to its standard output and its standard error since the last call, or so
    /// much of it that nobody works at it for long; waits for it, or for its end, at most so long.
    [[nodiscard]] std::string written(std::chrono::milliseconds patience);
    /// How it ended; nothing while it goes on.
    [[nodiscard]] std::optional<ChildEnd> ended();
    /// Asks it to end; what is left after 0.4 s is killed. Waits for that.
    void end();

    /// What SIGUSR1 makes kill it at once, with all that it started. The number is no other
    /// program's as long as this lives.
    [[nodiscard]] pid_t keeper() const noexcept { return child_; }

  private:
    pid_t child_{0};     ///< the keeper, which ends as the program does
    int life_{-1};       ///< of a pipe, whose other end the keeper watches
    int words_end_{-1};  ///< likewise, to read what it writes; negative: it has closed it
    std::optional<ChildEnd> end_{};
};

}  // namespace dibhr
