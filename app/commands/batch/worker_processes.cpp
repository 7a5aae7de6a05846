// Forks a process for each piece of work, and waits for their ends.
#include "app/commands/batch/worker_processes.hpp"

#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <system_error>
#include <utility>
#include <vector>

namespace dibhr {

namespace {

/// A child process; it is killed with this object.
class Worker {
  public:
    Worker(std::size_t piece, const std::function<int(std::size_t)>& work) : piece_(piece) {
        const pid_t parent = ::getpid();
        child_ = ::fork();
        if (child_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
        if (child_ == 0) live(parent, work);
        end_ = static_cast<int>(::syscall(SYS_pidfd_open, child_, 0));
        if (end_ < 0) {
            const int why = errno;
            kill_now();
            throw std::system_error(why, std::generic_category(), "pidfd_open");
        }
    }
    ~Worker() {
        if (child_ > 0) kill_now();
        if (end_ >= 0) ::close(end_);
    }
    Worker(Worker&& other) noexcept
        : piece_(other.piece_),
          child_(std::exchange(other.child_, 0)),
          end_(std::exchange(other.end_, -1)) {}
    Worker& operator=(Worker&& other) noexcept {
        std::swap(piece_, other.piece_);
        std::swap(child_, other.child_);
        std::swap(end_, other.end_);
        return *this;
    }

    [[nodiscard]] std::size_t piece() const noexcept { return piece_; }
    /// Readable when it has ended.
    [[nodiscard]] int descriptor() const noexcept { return end_; }
    void ask_to_end() const noexcept { ::kill(child_, SIGTERM); }

    /// Of a process that has ended.
    ChildEnd take_end() {
        int status = 0;
        while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
        child_ = 0;
        return WIFSIGNALED(status) ? ChildEnd{0, WTERMSIG(status)}
                                   : ChildEnd{WEXITSTATUS(status), 0};
    }

  private:
    [[noreturn]] void live(pid_t parent, const std::function<int(std::size_t)>& work) const {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(1);
        int result = 1;
        try {
            result = work(piece_);
        } catch (const std::exception&) {
            result = 1;  // `work` tells what it can
        }
        ::_exit(result);
    }
    void kill_now() noexcept {
        ::kill(child_, SIGKILL);
        while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
        }
        child_ = 0;
    }

    std::size_t piece_;
    pid_t child_{0};
    int end_{-1};
};

constexpr std::chrono::milliseconds kGrace{2000};  // then what has not ended is killed

/// Waits until one has ended, or a signal may have arrived.
void wait_for(const std::vector<Worker>& workers, int signals, std::chrono::milliseconds timeout) {
    std::vector<pollfd> waited;
    for (const Worker& worker : workers) waited.push_back({worker.descriptor(), POLLIN, 0});
    waited.push_back({signals, POLLIN, 0});  // poll(2): a negative one is ignored
    ::poll(waited.data(), waited.size(), static_cast<int>(timeout.count()));
}

/// Takes out those that have ended.
void take_ended(std::vector<Worker>& workers,
                const std::function<void(std::size_t, const ChildEnd&)>& ended) {
    for (std::size_t k = 0; k < workers.size();) {
        pollfd one{workers[k].descriptor(), POLLIN, 0};
        if (::poll(&one, 1, 0) != 1) {
            ++k;
            continue;
        }
        const std::size_t piece = workers[k].piece();
        const ChildEnd end = workers[k].take_end();
        std::swap(workers[k], workers.back());
        workers.pop_back();
        ended(piece, end);
    }
}

/// What ends well meanwhile counts.
void end_all(std::vector<Worker>& workers,
             const std::function<void(std::size_t, const ChildEnd&)>& ended) {
    for (const Worker& worker : workers) worker.ask_to_end();
    const auto until = std::chrono::steady_clock::now() + kGrace;
    for (auto now = until - kGrace; !workers.empty() && now < until;
         now = std::chrono::steady_clock::now()) {
        wait_for(workers, -1, std::chrono::ceil<std::chrono::milliseconds>(until - now));
        take_ended(workers, [&ended](std::size_t piece, const ChildEnd& end) {
            if (end.well()) ended(piece, end);
        });
    }
    workers.clear();
}

}  // namespace

std::size_t usable_processors() {
    cpu_set_t usable;
    CPU_ZERO(&usable);
    if (::sched_getaffinity(0, sizeof usable, &usable) != 0) return 1;
    return static_cast<std::size_t>(std::max(CPU_COUNT(&usable), 1));
}

bool run_in_processes(const WorkerRequest& request, ShutdownSignals& signals) {
    constexpr std::chrono::milliseconds kForEver{-1};
    std::vector<Worker> workers;
    for (std::size_t next = 0; next < request.count || !workers.empty();) {
        while (next < request.count && workers.size() < std::max<std::size_t>(request.at_once, 1))
            workers.emplace_back(next++, request.work);
        wait_for(workers, signals.descriptor(), kForEver);
        if (signals.arrived()) {
            end_all(workers, request.ended);
            return false;
        }
        take_ended(workers, request.ended);
    }
    return true;
}

}  // namespace dibhr
