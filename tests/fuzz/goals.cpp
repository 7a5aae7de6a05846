// GOALS.csv: what is read are finite numbers in order of time.
#include <cmath>

#include "core/haptics/vec.hpp"
#include "device/goal_stream.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::InputFile file("goals.csv");
    const auto& path = file.with({data, size});
    (void)test::is_taken([&path] {
        const auto goals = read_goals(path);
        test::require_rule(!goals.empty(), "there is a goal");
        double last_s = goals.front().t_s;
        for (const TimedGoal& goal : goals) {
            test::require_rule(std::isfinite(goal.t_s) && is_finite(goal.goal_in_grid),
                               "a goal is finite");
            test::require_rule(goal.t_s >= last_s, "times never fall");
            last_s = goal.t_s;
        }
    });
    return 0;
}
