// Work away from the window's thread, which never waits for it.
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

/// All who are on an errand, also those that nobody hears of any more: the end of the program must
/// not take away what they still use. For one thread.
class Errands {
  public:
    Errands() = default;
    Errands(const Errands&) = delete;
    Errands& operator=(const Errands&) = delete;

    /// To be kept by somebody's thread, which sets it at its exit.
    [[nodiscard]] std::promise<void> one_leaves() {
        std::erase_if(abroad_, [](const auto& one) { return is_home(one, {}); });
        std::promise<void> end;
        abroad_.push_back(end.get_future());
        return end;
    }

    /// Somebody who was waited for long enough, and is not coming.
    void give_one_up() { given_up_ = true; }

    /// Waits at most so long. Whether all have ended, with their threads: else the program may only
    /// end without destructors and handlers of exit(), by _exit().
    [[nodiscard]] bool come_home(std::chrono::milliseconds patience) const {
        const auto until = std::chrono::steady_clock::now() + patience;
        return !given_up_ && std::all_of(abroad_.begin(), abroad_.end(),
                                         [until](const auto& one) { return is_home(one, until); });
    }

  private:
    static bool is_home(const std::future<void>& one, std::chrono::steady_clock::time_point until) {
        return one.wait_until(until) == std::future_status::ready;
    }

    std::vector<std::future<void>> abroad_{};
    bool given_up_{false};
};

/// One piece of work at a time, on a thread of its own, which nobody waits for but Errands: a disk
/// that answers no more does not keep the program from leaving.
template <typename Result>
class Errand {
  public:
    /// `all` outlives it.
    explicit Errand(Errands& all) : all_(all) {}
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
        std::thread([task = std::move(task), end = all_.one_leaves()]() mutable {
            end.set_value_at_thread_exit();
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
    Errands& all_;
    std::future<Result> result_{};
};

/// Pieces of work away from the window's thread, one after the other: what is to last, and waits
/// for a disk.
class ErrandsInOrder {
  public:
    /// `all` outlives it.
    explicit ErrandsInOrder(Errands& all) : all_(all) {}
    ErrandsInOrder(const ErrandsInOrder&) = delete;
    ErrandsInOrder& operator=(const ErrandsInOrder&) = delete;

    /// `work` holds all that it needs.
    template <typename Work>
    void add(Work work) {
        std::packaged_task<void()> task([before = last_, work = std::move(work)]() mutable {
            if (before.valid()) before.wait();
            before = {};  // and with it what that one held
            work();
        });
        last_ = task.get_future().share();
        results_.push_back(last_);
        std::thread([task = std::move(task), end = all_.one_leaves()]() mutable {
            end.set_value_at_thread_exit();
            task.make_ready_at_thread_exit();
        }).detach();
    }

    /// Throws what the work has thrown, once.
    void look() {
        while (!results_.empty() &&
               results_.front().wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
            const std::shared_future<void> done = results_.front();
            results_.pop_front();
            done.get();
        }
    }

    /// The same, after waiting for it. Throws InputError, too, where it takes longer than
    /// `patience`.
    void finish(std::chrono::milliseconds patience) {
        const bool late = last_.valid() && last_.wait_for(patience) != std::future_status::ready;
        look();
        if (late)
            throw InputError(
                "the settings, and what dibhr remembers of files, are not saved: check whether the "
                "disk still works");
    }

    /// When all that was added until now is done; not valid: nothing was. For a thread that waits.
    [[nodiscard]] std::shared_future<void> done_so_far() const { return last_; }

  private:
    Errands& all_;
    std::shared_future<void> last_{};
    std::deque<std::shared_future<void>> results_{};
};

}  // namespace dibhr
