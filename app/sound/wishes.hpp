// What a thread is asked to do that may hang in somebody else's code, and how it is left.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace dibhr {

/// `Wish{}`: nothing is wanted. The thread must own this together with the one who asks.
template <typename Wish>
class Wishes {
  public:
    /// The asking thread's.
    void wish(const Wish& wish) {
        const std::lock_guard lock(mutex_);
        if (wish_ == wish) return;
        wish_ = wish;
        changed_.notify_all();
    }

    /// Asks it to leave, and waits half a second for that: one that hangs is left alone.
    void leave(std::thread& thread) {
        if (has_left_in_time()) {
            thread.join();
        } else {
            thread.detach();
        }
    }

    /// The asked thread's. Waits until something is wanted; nothing when it is to leave.
    [[nodiscard]] std::optional<Wish> wait() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return leaving_ || !(wish_ == Wish{}); });
        return leaving_ ? std::nullopt : std::optional<Wish>(wish_);
    }

    /// The asked thread's. Waits so long [s], or until something else is wanted: then false.
    [[nodiscard]] bool holds_for(const Wish& wish, double longest_s) {
        std::unique_lock lock(mutex_);
        return !changed_.wait_for(lock, std::chrono::duration<double>(longest_s),
                                  [&] { return leaving_ || !(wish_ == wish); });
    }

    /// The asked thread's last word.
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
