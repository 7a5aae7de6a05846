// Reads the goal columns of a session's ticks.
#include "core/session/session_goals.hpp"

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "core/session/session_reader.hpp"

namespace dibhr {

RecordedGoals read_session_goals(const std::filesystem::path& file, int lead_in, int count) {
    const SessionReader session(file);
    RecordedGoals recorded;
    SessionReader::Query facts(session, "SELECT key, value FROM session");
    while (facts.next()) recorded.facts[facts.text(0)] = facts.text(1);

    const auto lead = static_cast<std::size_t>(std::max(lead_in, 0));
    const auto most = static_cast<std::size_t>(std::max(count, 0));
    bool touched = false;
    SessionReader::Query ticks(
        session, "SELECT gx, gy, gz, frame, blend, contact FROM tick ORDER BY t, rowid");
    while (ticks.next()) {
        const Vec3 goal{ticks.real(0), ticks.real(1), ticks.real(2)};
        if (!is_finite(goal)) continue;
        recorded.goals.push_back({goal, ticks.integer(3), ticks.real(4)});
        if (!touched && ticks.integer(5) != 0) {
            touched = true;
            const std::size_t before = recorded.goals.size() - 1;
            const auto skipped = static_cast<std::ptrdiff_t>(before - std::min(before, lead));
            recorded.goals.erase(recorded.goals.begin(), recorded.goals.begin() + skipped);
        }
        if (touched && recorded.goals.size() >= most) break;
    }
    if (!touched) {
        throw InputError(file.string() +
                         ": nothing is touched in it; record a session with contact");
    }
    recorded.goals.resize(std::min(recorded.goals.size(), most));
    return recorded;
}

}  // namespace dibhr
