// A thread that calls a maker's library, of which a call may not return.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

namespace dibhr {

/// The end of such a thread, as it and its owner see it.
class ThreadEnd {
  public:
    using Span = std::chrono::milliseconds;

    void request() { stop_.request_stop(); }
    [[nodiscard]] bool requested() const noexcept { return stop_.stop_requested(); }
    [[nodiscard]] std::stop_token token() const noexcept { return stop_.get_token(); }
    /// False: the thread has not ended within that time.
    [[nodiscard]] bool comes_within(Span limit) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, limit, [this] { return ended_; });
    }

    // The thread alone:

    /// Waits until the end is requested, at most for that time.
    void pause(Span span) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop_.get_token(), span, [] { return false; });
    }
    void mark() {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        changed_.notify_all();
    }

  private:
    std::stop_source stop_{};
    std::mutex mutex_{};
    std::condition_variable_any changed_{};
    bool ended_{false};  // guarded by mutex_
};

/// Runs `Work::run()`, which returns soon after `Work::end` is requested. The thread has a share of
/// the work: where a call does not return, both outlive this object.
class LibraryThread {
  public:
    template <typename Work>
    explicit LibraryThread(const std::shared_ptr<Work>& work)
        : end_(work, &work->end), thread_([work] {
              work->run();
              work->end.mark();
          }) {}
    ~LibraryThread() { (void)end_within(ThreadEnd::Span(0)); }
    LibraryThread(const LibraryThread&) = delete;
    LibraryThread& operator=(const LibraryThread&) = delete;

    /// False: the thread has not ended within that time, and is left behind.
    bool end_within(ThreadEnd::Span limit) {
        if (!thread_.joinable()) return true;
        end_->request();
        const bool ended = end_->comes_within(limit);
        if (ended) thread_.join();
        if (!ended) thread_.detach();
        return ended;
    }

  private:
    std::shared_ptr<ThreadEnd> end_;
    std::thread thread_;
};

}  // namespace dibhr
