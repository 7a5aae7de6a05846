// Reads the goal columns of a session's ticks.
#include "core/session/session_goals.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>

#include "core/error.hpp"
#include "core/session/session.hpp"

namespace dibhr {

RecordedGoals read_session_goals(const std::filesystem::path& file, int lead_in, int count) {
    const Session session(file);
    RecordedGoals recorded;
    recorded.facts = session.facts();

    const auto lead = static_cast<std::size_t>(std::max(lead_in, 0));
    const auto most = static_cast<std::size_t>(std::max(count, 0));
    std::deque<RecordedGoal> before;  // the first contact
    bool touched = false;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) {
        if (!tick.surface || !is_finite(tick.goal)) continue;
        const RecordedGoal one{tick.goal, tick.frames.from_frame, tick.blend};
        if (!touched && !tick.contact) {
            before.push_back(one);
            if (before.size() > lead) before.pop_front();
            continue;
        }
        if (!touched) recorded.goals.assign(before.begin(), before.end());
        touched = true;
        recorded.goals.push_back(one);
        if (recorded.goals.size() >= most) break;
    }
    if (!touched) {
        throw InputError(file.string() +
                         ": nothing is touched in it; record a session with contact");
    }
    recorded.goals.resize(std::min(recorded.goals.size(), most));
    return recorded;
}

}  // namespace dibhr
