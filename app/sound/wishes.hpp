// Controls a thread that may hang in a driver or server: its latest request, and its stop.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace dibhr {

/// `Wish{}`: nothing to do. The thread and its controller own this object together.
template <typename Wish>
class Wishes {
  public:
    /// For the controlling thread: replaces the request.
    void wish(const Wish& wish) {
        const std::lock_guard lock(mutex_);
        if (wish_ == wish) return;
        wish_ = wish;
        changed_.notify_all();
    }

    /// Stops the thread and waits at most half a second; a thread that hangs is detached.
    void leave(std::thread& thread) {
        if (has_left_in_time()) {
            thread.join();
        } else {
            thread.detach();
        }
    }

    /// For the controlled thread. Waits for a request other than Wish{}; nothing: it must stop.
    [[nodiscard]] std::optional<Wish> wait() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return leaving_ || !(wish_ == Wish{}); });
        return leaving_ ? std::nullopt : std::optional<Wish>(wish_);
    }

    /// For the controlled thread. Waits `longest_s`, or until the request changes: then false.
    [[nodiscard]] bool holds_for(const Wish& wish, double longest_s) {
        std::unique_lock lock(mutex_);
        return !changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                                  [&] { return leaving_ || !(wish_ == wish); });
    }

    /// The last call of the controlled thread.
    void say_left() {
        const std::lock_guard lock(mutex_);
        left_ = true;
        changed_.notify_all();
    }

  private:
    [[nodiscard]] bool has_left_in_time() {
        constexpr auto kPatience = std::chrono::milliseconds(500);
        std::unique_lock lock(mutex_);
        leaving_ = true;
        changed_.notify_all();
        return changed_.wait_for(lock, kPatience, [this] { return left_; });
    }

    std::mutex mutex_{};
    std::condition_variable changed_{};
    // Under the mutex.
    Wish wish_{};
    bool leaving_{false};
    bool left_{false};
};

}  // namespace dibhr
