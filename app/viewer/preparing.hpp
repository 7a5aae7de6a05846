// Prepares the shown recording while the window goes on.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/viewer/task_group.hpp"
#include "core/video/playing/prepared_cache.hpp"

namespace dibhr {

/// What became of it.
struct PreparingEnd {
    std::optional<Prepared> made{};  ///< nothing: cancelled or failed
    std::string failure{};
};

class ViewerPreparing {
  public:
    /// The task group must outlive it.
    explicit ViewerPreparing(TaskGroup& tasks) : making_(tasks) {}
    ~ViewerPreparing() { end(); }
    ViewerPreparing(const ViewerPreparing&) = delete;
    ViewerPreparing& operator=(const ViewerPreparing&) = delete;

    /// Begins, or, where it has begun, cancels.
    void begin_or_cancel(ViewerState& state);
    /// Once a turn: updates the progress. The result, once; `failure` is empty where it was
    /// cancelled.
    [[nodiscard]] std::optional<PreparingEnd> poll(ViewerState& state);
    /// Whether the shown recording is the one that was prepared last.
    [[nodiscard]] bool shows_prepared(const ViewerState& state) const;
    /// At the end of the program: breaks off.
    void end();

  private:
    struct Watch {
        std::atomic<double> share{0.0};
        std::atomic<bool> stops{false};
    };

    BackgroundTask<PreparingEnd> making_;
    std::shared_ptr<Watch> watch_{};
    OpenRequest prepares_{};
};

}  // namespace dibhr
