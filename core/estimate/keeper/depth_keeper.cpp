// Runs an estimator for dibhr, and kills all its processes when it or dibhr ends:
// depth-keeper LIFE TROUBLE PROGRAM... LIFE is a pipe whose other end dibhr holds while it lives;
// into TROUBLE goes an errno when the program cannot be started. This is a separate program, since
// a copy of dibhr's memory would disturb the haptic thread.
#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kGrace{400};  ///< from SIGTERM to SIGKILL

/// Whether that process is our child; also an ended one that was not waited for.
bool is_child(const char* pid) {
    char name[64];
    char line[512];
    std::snprintf(name, sizeof name, "/proc/%.20s/stat", pid);
    const int stat = ::open(name, O_RDONLY | O_CLOEXEC);
    const ssize_t got = stat < 0 ? 0 : ::read(stat, line, sizeof line - 1);
    if (stat >= 0) ::close(stat);
    line[got > 0 ? got : 0] = '\0';
    const char* const behind_name = std::strrchr(line, ')');  // then " S 1234 ": state, parent
    return behind_name != nullptr && std::atoi(behind_name + 3) == ::getpid();
}

/// Kills all children. A process that has lost its parent becomes this program's child, in any
/// group or session. True: there was one that it may kill.
bool kill_children() {
    bool any = false;
    DIR* const processes = ::opendir("/proc");
    while (const dirent* const process = processes != nullptr ? ::readdir(processes) : nullptr) {
        if (process->d_name[0] < '1' || process->d_name[0] > '9' || !is_child(process->d_name))
            continue;
        if (::kill(std::atoi(process->d_name), SIGKILL) == 0) any = true;
    }
    if (processes != nullptr) ::closedir(processes);
    return any;
}

[[noreturn]] void exec_estimator(char** words, int life, int trouble) {
    sigset_t none;
    ::sigemptyset(&none);
    ::close(life);
    ::fcntl(trouble, F_SETFD, FD_CLOEXEC);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::execvp(words[0], words);
    const int why = errno;
    [[maybe_unused]] const ssize_t reported = ::write(trouble, &why, sizeof why);
    ::_exit(EXIT_FAILURE);
}

/// Watches the estimator: SIGTERM ends it with a grace time, SIGUSR1 kills it at once.
class Watch {
  public:
    Watch(pid_t estimator, int life) : estimator_(estimator), life_(life) {
        sigset_t handled;
        ::sigemptyset(&handled);
        for (const int signal : {SIGCHLD, SIGTERM, SIGUSR1}) ::sigaddset(&handled, signal);
        signals_ = ::signalfd(-1, &handled, SFD_CLOEXEC | SFD_NONBLOCK);
    }

    /// Waits until no process of the estimator is left. Returns its status.
    int wait_until_over() {
        while (!ended_ && !at_once_) {
            pollfd events[]{{life_, POLLIN, 0}, {signals_, POLLIN, 0}};
            ::poll(events, 2, timeout_ms());
            if (events[0].revents != 0) at_once_ = true;  // dibhr has ended
            take_signals();
            reap(::waitpid(-1, &status_of_one_, WNOHANG));
            if (latest_ <= Clock::now()) at_once_ = true;
        }
        pid_t gone = 0;
        do {
            gone = ::waitpid(-1, &status_of_one_, kill_children() ? 0 : WNOHANG);
            reap(gone);
        } while (gone > 0);
        return status_;
    }

  private:
    [[nodiscard]] int timeout_ms() const {
        if (latest_ == Clock::time_point::max()) return -1;
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(latest_ - Clock::now());
        return left.count() < 0 ? 0 : static_cast<int>(left.count()) + 1;
    }
    void take_signals() {
        signalfd_siginfo signal{};
        while (::read(signals_, &signal, sizeof signal) == sizeof signal) {
            if (signal.ssi_signo == SIGUSR1) at_once_ = true;
            if (signal.ssi_signo != SIGTERM) continue;
            ::kill(-estimator_, SIGTERM);
            latest_ = Clock::now() + kGrace;
        }
    }
    void reap(pid_t gone) {
        if (gone != estimator_) return;
        ended_ = true;
        status_ = status_of_one_;
    }

    pid_t estimator_;
    int life_;
    int signals_{-1};
    int status_{0}, status_of_one_{0};
    bool ended_{false};
    bool at_once_{false};
    Clock::time_point latest_{Clock::time_point::max()};  ///< then it is killed
};

/// Ends this program as the estimator ended.
[[noreturn]] void end_as(int status) {
    if (!WIFSIGNALED(status)) ::_exit(WEXITSTATUS(status));
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    sigset_t none;
    ::sigemptyset(&none);
    ::signal(WTERMSIG(status), SIG_DFL);
    ::raise(WTERMSIG(status));
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::_exit(EXIT_FAILURE);
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 4) return EXIT_FAILURE;
    const int life = std::atoi(arguments[1]);
    const int trouble = std::atoi(arguments[2]);
    sigset_t all;
    ::sigfillset(&all);
    ::sigprocmask(SIG_SETMASK, &all, nullptr);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    const pid_t estimator = ::fork();
    if (estimator == 0) exec_estimator(arguments + 3, life, trouble);
    const int why = errno;
    if (estimator < 0) return ::write(trouble, &why, sizeof why) > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
    ::setpgid(estimator, estimator);
    ::close(trouble);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
    end_as(Watch(estimator, life).wait_until_over());
}
