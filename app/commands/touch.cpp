// `dibhr touch`: computes first and formats afterwards, block by block, so that the times are the
// updates' own.
#include "app/commands/touch.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands/output_rows.hpp"
#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/haptics/touch.hpp"
#include "core/video/depth_in_time.hpp"
#include "device/goal_stream.hpp"

namespace dibhr {
namespace {

constexpr std::size_t kBlockRows = 4096;
constexpr std::size_t kRoomPerRow_bytes = 400;
constexpr double kUsualTick_s = 0.001;

void refuse_to_overwrite_input(const TouchOptions& options) {
    for (const auto& input : {options.depth, options.goals, options.bump}) {
        std::error_code missing;
        if (std::filesystem::equivalent(input, options.out, missing)) {
            throw InputError(options.out.string() +
                             ": is also read by this command; give --out another name");
        }
    }
}

/// Keeps all that an update depends on from one block of goals to the next.
class TouchRun {
  public:
    explicit TouchRun(const TouchOptions& options)
        : parameters_(options.parameters),
          depth_(open_depth(options.depth), options.video,
                 options.raw_depth ? CleaningOptions{false, false, false} : CleaningOptions{}) {
        if (!options.bump.empty()) bump_ = read_bump_map(options.bump);
        input_.restart = true;
    }

    void compute(std::span<const TimedGoal> goals, std::vector<OutputRow>& rows) {
        rows.clear();
        for (const TimedGoal& goal : goals) rows.push_back(update(goal));
    }

  private:
    OutputRow update(const TimedGoal& goal) {
        if (depth_.advance_to(goal.t_s)) input_.restart = true;
        // Recorded hands have equal time stamps: still an update, of the usual length.
        const double step_s = last_t_s_ ? goal.t_s - *last_t_s_ : 0.0;
        input_.dt_s = step_s > 0.0 ? step_s : kUsualTick_s;
        const DepthSurface surface =
            depth_.now().surface(parameters_.shape, bump_ ? &*bump_ : nullptr);

        const auto start = std::chrono::steady_clock::now();
        const Touch& touch =
            renderer_.update(surface, goal.goal_in_grid, parameters_, input_, limits_);
        const auto end = std::chrono::steady_clock::now();

        last_t_s_ = goal.t_s;
        input_.restart = false;
        return row_of(goal.t_s, touch,
                      std::chrono::duration_cast<std::chrono::nanoseconds>(end - start).count());
    }

    TouchParameters parameters_;
    DepthInTime depth_;
    std::optional<BumpMap> bump_{};
    TouchRenderer renderer_{};
    SafetyInput input_{};
    SafetyLimits limits_{};
    std::optional<double> last_t_s_{};
};

}  // namespace

int run_touch(const TouchOptions& options) {
    const std::vector<TimedGoal> goals = read_goals(options.goals);
    TouchRun run(options);
    refuse_to_overwrite_input(options);
    OutputFile out(options.out);

    std::vector<OutputRow> rows;
    rows.reserve(kBlockRows);
    std::string text(kOutputHeader);
    text.reserve(kBlockRows * kRoomPerRow_bytes);
    for (std::size_t done = 0; done < goals.size(); done += kBlockRows) {
        const std::size_t count = std::min(kBlockRows, goals.size() - done);
        run.compute(std::span(goals).subspan(done, count), rows);
        for (const OutputRow& row : rows) append_row(text, row);
        out.write(text);
        text.clear();
    }
    out.commit();
    return 0;
}

}  // namespace dibhr
