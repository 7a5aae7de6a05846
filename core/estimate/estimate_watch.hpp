// How an estimation goes, and the wish to end it, between the thread that makes it and who watches.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

namespace dibhr {

/// What is done now.
enum class EstimateStep { looking, giving_frames, estimating, checking };

struct EstimateProgress {
    EstimateStep step{EstimateStep::looking};
    std::size_t done{0}, of{0};  ///< frames; of 0: not known yet
    bool counted{false};         ///< `done` is known: the estimator shows it
    std::optional<double> left_s{};
    double elapsed_s{0.0};  ///< since the estimator was started
    std::string said{};     ///< the last line of the estimator

    /// Of this step, 0 to 1.
    [[nodiscard]] double share() const noexcept {
        return of == 0 ? 0.0 : static_cast<double>(done) / static_cast<double>(of);
    }
};

/// "estimating frame 7 of 24, 0:12 left", "estimating, 1:05"
[[nodiscard]] std::string in_words(const EstimateProgress& progress);

/// For any thread.
class EstimateWatch {
  public:
    /// What is done so far stays for the next time.
    void stop() noexcept { stop_ = true; }
    /// The same, and the estimator is killed now: this program ends.
    void stop_at_once() noexcept;
    [[nodiscard]] const std::atomic<bool>& stopped() const noexcept { return stop_; }

    void tell(const EstimateProgress& progress);
    [[nodiscard]] EstimateProgress progress() const;

    /// The estimator's keeper; 0: none runs.
    void runs(pid_t keeper);

  private:
    std::atomic<bool> stop_{false};
    mutable std::mutex mutex_{};  ///< of all below
    EstimateProgress progress_{};
    pid_t keeper_{0};
    bool at_once_{false};
};

}  // namespace dibhr
