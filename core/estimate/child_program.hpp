// Another program, started in a process group of its own and ended with all that it started.
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
    /// So long it may take to end when it is asked to.
    static constexpr std::chrono::milliseconds kGrace{400};

    /// Starts it, without a shell and without a keyboard. Throws InputError when that cannot be:
    /// what, and what to do next. It is killed when the thread that calls ends, even where that is
    /// because this program was killed; what it started itself is not.
    ChildProgram(std::vector<std::string> words, ChildManner manner);
    /// Kills what is left of its group.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// What it has written to its standard output and its standard error since the last call; waits
    /// for it, or for its end, at most so long.
    [[nodiscard]] std::string written(std::chrono::milliseconds patience);
    /// How it ended; nothing while it goes on.
    [[nodiscard]] std::optional<ChildEnd> ended();
    /// Asks all of the group to end, and kills what is left after kGrace. Waits for that.
    void end();

    [[nodiscard]] pid_t group() const noexcept { return child_; }

  private:
    pid_t child_{0};
    int words_end_{-1};  ///< of a pipe, to read what it writes; negative: it has closed it
    std::optional<ChildEnd> end_{};
};

}  // namespace dibhr
