// Controls a thread that may hang in a driver or server: its latest request, and its stop.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace dibhr {

/// `Wish{}`: nothing to do. The thread and its controller own this object together.
template <typename Request>
class WorkerControl {
  public:
    /// For the controlling thread: replaces the request.
    void request(const Request& request) {
        const std::lock_guard lock(mutex_);
        if (request_ == request) return;
        request_ = request;
        changed_.notify_all();
    }

    /// Stops the thread and waits at most half a second; a thread that hangs is detached.
    void stop(std::thread& thread) {
        if (has_stopped_in_time()) {
            thread.join();
        } else {
            thread.detach();
        }
    }

    /// For the controlled thread. Waits for a request other than Wish{}; nothing: it must stop.
    [[nodiscard]] std::optional<Request> wait() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return stopping_ || !(request_ == Request{}); });
        return stopping_ ? std::nullopt : std::optional<Request>(request_);
    }

    /// For the controlled thread. Waits `longest_s`, or until the request changes: then false.
    [[nodiscard]] bool unchanged_for(const Request& request, double longest_s) {
        std::unique_lock lock(mutex_);
        return !changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                                  [&] { return stopping_ || !(request_ == request); });
    }

    /// The last call of the controlled thread.
    void report_stopped() {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        changed_.notify_all();
    }

  private:
    [[nodiscard]] bool has_stopped_in_time() {
        constexpr auto kStopTimeout = std::chrono::milliseconds(500);
        std::unique_lock lock(mutex_);
        stopping_ = true;
        changed_.notify_all();
        return changed_.wait_for(lock, kStopTimeout, [this] { return stopped_; });
    }

    std::mutex mutex_{};
    std::condition_variable changed_{};
    // Under the mutex.
    Request request_{};
    bool stopping_{false};
    bool stopped_{false};
};

}  // namespace dibhr
