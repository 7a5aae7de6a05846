// The progress and the stop request of an estimation, shared by its thread and by others.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

namespace dibhr {

/// The present step.
enum class EstimateStep { inspecting, reading_frames, estimating, checking };

struct EstimateProgress {
    EstimateStep step{EstimateStep::inspecting};
    std::size_t done{0}, of{0};  ///< frames; of 0: not known yet
    bool counted{false};         ///< `done` is known from the estimator
    std::optional<double> left_s{};
    double elapsed_s{0.0};  ///< since the estimator was started
    std::string said{};     ///< the last line of the estimator

    /// The part of this step that is done, 0 to 1.
    [[nodiscard]] double share() const noexcept {
        return of == 0 ? 0.0 : static_cast<double>(done) / static_cast<double>(of);
    }
};

/// "estimating frame 7 of 24, 0:12 left", "estimating, 1:05"
[[nodiscard]] std::string in_words(const EstimateProgress& progress);

/// For any thread.
class EstimateWatch {
  public:
    /// Stops; finished frames stay for the next run.
    void stop() noexcept { stop_ = true; }
    /// The same, and kills the estimator now: this program is about to end.
    void stop_at_once() noexcept;
    [[nodiscard]] const std::atomic<bool>& stopped() const noexcept { return stop_; }

    void report(const EstimateProgress& progress);
    [[nodiscard]] EstimateProgress progress() const;

    /// Sets the estimator's keeper; 0: none runs.
    void set_keeper(pid_t keeper);

  private:
    std::atomic<bool> stop_{false};
    mutable std::mutex mutex_{};  ///< of all members below
    EstimateProgress progress_{};
    pid_t keeper_{0};
    bool at_once_{false};
};

}  // namespace dibhr
