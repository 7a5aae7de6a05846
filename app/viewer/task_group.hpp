// Work on other threads, for which the window's thread never waits.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace dibhr {

/// All threads of background tasks, also of tasks whose result is no longer needed: at the end of
/// the program nothing that they still use may be destroyed. For use by one thread.
class TaskGroup {
  public:
    TaskGroup() = default;
    TaskGroup(const TaskGroup&) = delete;
    TaskGroup& operator=(const TaskGroup&) = delete;

    /// Registers a thread, which must own the promise and set it at its exit.
    [[nodiscard]] std::promise<void> add_thread() {
        std::erase_if(thread_ends_, [](const auto& one) { return has_ended(one, {}); });
        std::promise<void> end;
        thread_ends_.push_back(end.get_future());
        return end;
    }

    /// A registered or other thread hangs: wait for none any more.
    void abandon_one() { abandoned_ = true; }

    /// Waits for all threads, at most so long. False: some run on, and the program must end by
    /// _exit(), without destructors and handlers of exit().
    [[nodiscard]] bool wait_all(std::chrono::milliseconds patience) const {
        const auto until = std::chrono::steady_clock::now() + patience;
        return !abandoned_ &&
               std::all_of(thread_ends_.begin(), thread_ends_.end(),
                           [until](const auto& one) { return has_ended(one, until); });
    }

  private:
    static bool has_ended(const std::future<void>& one,
                          std::chrono::steady_clock::time_point until) {
        return one.wait_until(until) == std::future_status::ready;
    }

    std::vector<std::future<void>> thread_ends_{};
    bool abandoned_{false};
};

/// One task at a time, on a thread of its own. Only the group waits for it, with a timeout, so that
/// a disk that hangs does not keep the program from ending.
template <typename Result>
class BackgroundTask {
  public:
    /// The task group must outlive it.
    explicit BackgroundTask(TaskGroup& tasks) : tasks_(tasks) {}
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    [[nodiscard]] bool running() const { return result_.valid(); }

    /// Starts `work`; false while a task is running. `work` must own all that it uses: it may
    /// outlive this object.
    template <typename Work>
    bool start(Work work) {
        if (running()) return false;
        restart(std::move(work));
        return true;
    }

    /// Starts `work` in any case. A running task runs on, but its result is dropped.
    template <typename Work>
    void restart(Work work) {
        std::packaged_task<Result()> task(std::move(work));
        std::future<Result> result = task.get_future();
        std::thread([task = std::move(task), end = tasks_.add_thread()]() mutable {
            end.set_value_at_thread_exit();
            task();
        }).detach();
        result_ = std::move(result);
    }

    /// A running task runs on, but its result is dropped.
    void drop() { result_ = {}; }

    /// The result, once it is there, once. Throws what `work` threw.
    [[nodiscard]] std::optional<Result> take() {
        if (!running() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return std::nullopt;
        return result_.get();
    }

    void wait_until(std::chrono::steady_clock::time_point latest) const {
        if (running()) result_.wait_until(latest);
    }

  private:
    TaskGroup& tasks_;
    std::future<Result> result_{};
};

/// Tasks on other threads, one after the other: for writing files, which may wait for a disk.
class TaskQueue {
  public:
    /// The task group must outlive it.
    explicit TaskQueue(TaskGroup& tasks) : tasks_(tasks) {}
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    /// `work` must own all that it uses.
    template <typename Work>
    void add(Work work) {
        std::packaged_task<void()> task([before = last_, work = std::move(work)]() mutable {
            if (before.valid()) before.wait();
            before = {};  // frees what the last task owned
            work();
        });
        last_ = task.get_future().share();
        results_.push_back(last_);
        std::thread([task = std::move(task), end = tasks_.add_thread()]() mutable {
            end.set_value_at_thread_exit();
            task.make_ready_at_thread_exit();
        }).detach();
    }

    /// Throws what a finished task has thrown, once.
    void poll() {
        while (!results_.empty() &&
               results_.front().wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
            const std::shared_future<void> done = results_.front();
            results_.pop_front();
            done.get();
        }
    }

    /// The same for all tasks, after waiting. Throws InputError, too, where that takes longer than
    /// `patience`.
    void finish(std::chrono::milliseconds patience) {
        const bool late = last_.valid() && last_.wait_for(patience) != std::future_status::ready;
        poll();
        if (late)
            throw InputError(
                "the settings, and what dibhr remembers of files, are not saved: check whether the "
                "disk still works");
    }

    /// Ready when all tasks added so far are done; not valid: none was added.
    [[nodiscard]] std::shared_future<void> done_so_far() const { return last_; }

  private:
    TaskGroup& tasks_;
    std::shared_future<void> last_{};
    std::deque<std::shared_future<void>> results_{};
};

}  // namespace dibhr
