// Runs a program under a keeper (keeper/depth_keeper.cpp), which ends it with all its children.
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
    int signal{0};  ///< that killed it; 0: it exited

    [[nodiscard]] bool well() const noexcept { return exit_code == 0 && signal == 0; }
};

/// "ended with 1", "was ended by signal 11 (Segmentation fault)"
[[nodiscard]] std::string in_words(const ChildEnd& end);

/// The priority of a program.
enum class ChildPriority { normal, low };

/// Lowers the priority of that process or thread and of all that it starts from now on; 0: the
/// calling thread.
void lower_priority(pid_t who) noexcept;

class ChildProgram {
  public:
    /// Starts the program, without a shell and without standard input. Throws InputError when that
    /// fails: what, and what to do next. However dibhr ends, the program is killed then, with all
    /// that it started.
    ChildProgram(std::vector<std::string> words, ChildPriority priority);
    /// Kills what is left of the program.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// Reads what the program has written to standard output and standard error since the last
    /// call, up to a bound; waits at most so long for output, or for the program's end.
    [[nodiscard]] std::string written(std::chrono::milliseconds timeout);
    /// How the program ended; nothing while it runs.
    [[nodiscard]] std::optional<ChildEnd> ended();
    /// Sends SIGTERM; kills what is left after 0.4 s. Waits for that.
    void end();

    /// The keeper, which on SIGUSR1 kills the program at once with all that it started. The number
    /// belongs to no other process while this object lives.
    [[nodiscard]] pid_t keeper() const noexcept { return child_; }

  private:
    pid_t child_{0};      ///< the keeper, which exits as the program does
    int life_{-1};        ///< our end of a pipe; the keeper sees when it closes
    int output_end_{-1};  ///< the pipe of the program's output; negative: closed
    std::optional<ChildEnd> end_{};
};

}  // namespace dibhr
