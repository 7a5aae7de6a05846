// Starts a keeper by vfork, reads its pipes, and sends it signals.
#include "core/estimate/child_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "core/error.hpp"
#include "core/files/module.hpp"
#include "core/files/plain_text.hpp"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): glibc's needs _GNU_SOURCE

namespace dibhr {

namespace {

constexpr int kLowNice = 10;                                     // nice(2)
constexpr std::size_t kMostOutput_bytes = std::size_t{1} << 16;  ///< bytes read at once

/// The arguments with a null at the end, as exec needs them.
std::vector<char*> as_pointers(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// This program's environment, with Python set to print without a buffer.
std::vector<std::string> environment() {
    constexpr std::string_view kUnbuffered = "PYTHONUNBUFFERED=";
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (!std::string_view(*entry).starts_with(kUnbuffered)) all.emplace_back(*entry);
    all.push_back(std::string(kUnbuffered) + "1");
    return all;
}

[[noreturn]] void refuse(const std::string& program, int why) {
    if (why < 0)
        throw InputError(
            "no estimator can be started: " + part_of_program("depth-keeper").string() + " (" +
            std::strerror(-why) + "); end other programs, or install dibhr again");
    const std::string name = in_quotes(program, 200);
    if (why == ENOENT && ::access(program.c_str(), F_OK) == 0)
        throw InputError("the estimator cannot be started: the program that the first line of " +
                         name + " names (#!) is not there; install it, or correct that line");
    if (why == ENOENT)
        throw InputError("the estimator cannot be started: there is no program " + name +
                         "; install it, or write its whole path into the command");
    if (why == EACCES || why == ENOEXEC)
        throw InputError("the estimator cannot be started: " + name +
                         " cannot be executed; make it executable (chmod +x), or name the program "
                         "that runs it before it");
    throw InputError("the estimator cannot be started: " + name + " (" + std::strerror(why) + ")");
}

/// The ends of pipes that the keeper gets.
struct Ends {
    int output{-1}, life{-1}, trouble{-1};
};

/// Runs in the child between vfork and exec. The child shares this program's memory, so this uses
/// system calls only and changes nothing. On failure writes -errno to `trouble`.
[[noreturn]] void exec_keeper(char* const* words, char** variables, const Ends& ends,
                              ChildPriority priority) {
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;  // NOLINT(cppcoreguidelines-pro-type-union-access): POSIX's
    for (const int signal : {SIGPIPE, SIGTERM, SIGINT, SIGHUP, SIGQUIT})
        ::sigaction(signal, &usual, nullptr);
    if (priority == ChildPriority::low) lower_priority(0);
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    const bool ready =
        ::setpgid(0, 0) == 0 && nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
        ::dup2(ends.output, STDOUT_FILENO) >= 0 && ::dup2(ends.output, STDERR_FILENO) >= 0 &&
        ::fcntl(ends.life, F_SETFD, 0) == 0 && ::fcntl(ends.trouble, F_SETFD, 0) == 0;
    if (ready) ::execve(words[0], words, variables);
    const int why = -errno;
    [[maybe_unused]] const ssize_t reported = ::write(ends.trouble, &why, sizeof why);
    ::_exit(EXIT_FAILURE);
}

/// Returns 0, the errno of the program, or -errno of its keeper. The child uses this program's
/// memory until exec, as in posix_spawn: copying the memory would disturb the haptic thread.
int start(const std::vector<std::string>& program, Ends ends, ChildPriority priority,
          pid_t& child) {
    // A successful exec closes this pipe. (A pipe and not memory: with a sanitizer vfork() shares
    // none.)
    std::array<int, 2> trouble{};
    if (::pipe2(trouble.data(), O_CLOEXEC) != 0) return -errno;
    ends.trouble = trouble[1];
    std::vector<std::string> words{part_of_program("depth-keeper").string(),
                                   std::to_string(ends.life), std::to_string(ends.trouble)};
    words.insert(words.end(), program.begin(), program.end());
    std::vector<std::string> variables = environment();
    const std::vector<char*> arguments = as_pointers(words);
    std::vector<char*> entries = as_pointers(variables);
    int why = 0;
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);  // our handlers must not run in the child
    const pid_t started = ::vfork();  // NOLINT(clang-analyzer-security.insecureAPI.vfork)
    if (started == 0) exec_keeper(arguments.data(), entries.data(), ends, priority);
    if (started < 0) why = -errno;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    child = started;
    ::close(trouble[1]);
    if (started > 0 && ::read(trouble[0], &why, sizeof why) > 0) ::waitpid(started, nullptr, 0);
    ::close(trouble[0]);
    return why;
}

}  // namespace

std::string in_words(const ChildEnd& end) {
    if (end.signal == 0) return "ended with " + std::to_string(end.exit_code);
    return "was ended by signal " + std::to_string(end.signal) + " (" + ::strsignal(end.signal) +
           ")";
}

void lower_priority(pid_t who) noexcept {
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(who), kLowNice);
}

ChildProgram::ChildProgram(std::vector<std::string> words, ChildPriority priority) {
    std::array<int, 2> output{-1, -1}, life{};
    if (::pipe2(output.data(), O_CLOEXEC) != 0 || ::pipe2(life.data(), O_CLOEXEC) != 0) {
        for (const int end : output) ::close(end);  // those that were opened
        throw InputError("the estimator cannot be started: too many files are open");
    }
    const int failed = start(words, {.output = output[1], .life = life[0]}, priority, child_);
    ::close(output[1]);
    ::close(life[0]);
    output_end_ = output[0];
    life_ = life[1];
    if (failed != 0) {
        ::close(output_end_);
        ::close(life_);
        refuse(words.front(), failed);
    }
    ::fcntl(output_end_, F_SETFL, O_NONBLOCK);
}

ChildProgram::~ChildProgram() {
    ::close(life_);
    // Reaped only here: until now no other process can get its number.
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    if (output_end_ >= 0) ::close(output_end_);
}

std::string ChildProgram::written(std::chrono::milliseconds timeout) {
    if (output_end_ < 0) {
        if (!end_) std::this_thread::sleep_for(timeout);
        return {};
    }
    pollfd reading{output_end_, POLLIN, 0};
    ::poll(&reading, 1, static_cast<int>(timeout.count()));
    std::string text;
    std::array<char, 4096> piece{};
    ssize_t count = 1;
    while (text.size() < kMostOutput_bytes &&
           (count = ::read(output_end_, piece.data(), piece.size())) > 0)
        text.append(piece.data(), static_cast<std::size_t>(count));
    if (count == 0) {
        ::close(output_end_);
        output_end_ = -1;
    }
    return text;
}

std::optional<ChildEnd> ChildProgram::ended() {
    siginfo_t how{};
    if (!end_ &&
        ::waitid(P_PID, static_cast<id_t>(child_), &how, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        how.si_pid == child_) {
        end_ = how.si_code == CLD_EXITED ? ChildEnd{how.si_status, 0} : ChildEnd{0, how.si_status};
    }
    return end_;
}

void ChildProgram::end() {
    if (ended()) return;
    ::kill(child_, SIGTERM);
    siginfo_t how{};
    while (::waitid(P_PID, static_cast<id_t>(child_), &how, WEXITED | WNOWAIT) != 0 &&
           errno == EINTR) {
    }
    end_ = ChildEnd{0, SIGKILL};
}

}  // namespace dibhr
