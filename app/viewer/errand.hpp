// Work away from the window's thread, which never waits for it.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <thread>
#include <utility>

namespace dibhr {

/// One piece of work at a time, on a thread of its own. At the end it is waited for a little: a
/// disk that answers no more does not keep the program from leaving.
template <typename Result>
class Errand {
  public:
    Errand() = default;
    ~Errand() {
        if (under_way()) result_.wait_for(kPatience);
    }
    Errand(const Errand&) = delete;
    Errand& operator=(const Errand&) = delete;

    [[nodiscard]] bool under_way() const { return result_.valid(); }

    /// Begins, unless one is under way: then false. `work` holds all that it needs: it may live
    /// longer than whoever sent it.
    template <typename Work>
    bool start(Work work) {
        if (under_way()) return false;
        start_anew(std::move(work));
        return true;
    }

    /// The same, and what is under way is left to itself: nobody hears of it any more.
    template <typename Work>
    void start_anew(Work work) {
        std::packaged_task<Result()> task(std::move(work));
        std::future<Result> result = task.get_future();
        std::thread([task = std::move(task)]() mutable {
            task.make_ready_at_thread_exit();
        }).detach();
        result_ = std::move(result);
    }

    /// What came of it, once. Throws what the work threw.
    [[nodiscard]] std::optional<Result> take() {
        if (!under_way() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return std::nullopt;
        return result_.get();
    }

    void wait_until(std::chrono::steady_clock::time_point latest) const {
        if (under_way()) result_.wait_until(latest);
    }

  private:
    static constexpr auto kPatience = std::chrono::milliseconds(500);

    std::future<Result> result_{};
};

}  // namespace dibhr
